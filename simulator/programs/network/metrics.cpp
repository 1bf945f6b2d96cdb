// No program at all: the distances of a network, to be compared with what books say of it.
#include <cstdio>
#include <limits>

#include "simulator/declare/program.hpp"
#include "topologies/graph/metrics.hpp"

namespace programs {

namespace {

// "mesh:4x6" has 4 rows and 6 columns; any other network is one row.
struct Grid {
  int rows = 1, columns = 1;
};

Grid grid_of(const topologies::Topology& topology) {
  Grid grid{1, topology.processors};
  const auto sizes = topology.name.find(':');
  if (sizes == std::string::npos) return grid;
  Grid named;
  if (std::sscanf(topology.name.c_str() + sizes, ":%dx%d", &named.rows, &named.columns) == 2)
    grid = named;
  return grid;
}

Row run(const Setup& setup) {
  const Grid grid = grid_of(setup.topology);
  const auto metrics = topologies::eval_metrics(setup.topology);
  constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();
  return {{"processors", metrics.processors},
          {"rows", grid.rows},
          {"columns", grid.columns},
          {"links", metrics.links},
          {"degree_max", metrics.degree_max},
          {"diameter", metrics.diameter},
          {"mean_distance", metrics.mean_distance},
          {"bisection", metrics.bisection_width ? *metrics.bisection_width : UNKNOWN}};
}

}  // namespace

Pattern make_metrics() {
  return {"metrics",
          "nothing runs: rows and columns, links, largest degree, diameter, mean_distance and "
          "bisection of the network",
          true,
          {},
          &run};
}

}  // namespace programs

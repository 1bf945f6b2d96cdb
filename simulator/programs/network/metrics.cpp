// No program at all: the distances of a network, to be compared with what books say of it.
#include "topologies/graph/metrics.hpp"
#include "simulator/declare/program.hpp"

namespace programs {

namespace {

struct Params {};

// Rows and columns of a mesh or torus; any other network is one row.
struct Grid {
  int rows = 1, columns = 1;
};

struct Measured : topologies::Metrics, Grid {};

Grid grid_of(const topologies::Topology& topology) {
  const auto& [form, rows, columns] = topology.shape;
  if (form == topologies::Shape::Form::grid) return {rows, columns};
  return {1, topology.processors};
}

Outcome<Measured> run(const Setup& setup, const Params&) {
  return Measured{topologies::eval_metrics(setup.topology), grid_of(setup.topology)};
}

template <class Member>
base::Column<Measured> column(const std::string& name, Member member, const std::string& help) {
  return base::column<Measured, Member>(name, member, help);
}

}  // namespace

Program make_metrics() {
  return make_program<Params, Measured>(
      {.name = "metrics",
       .help = "distances of a network, to be compared with what books say; nothing runs",
       .uses = {.network = true},
       .columns = {column("processors", &Measured::processors, "processors"),
                   column("rows", &Measured::rows, "rows of a mesh or torus; else 1"),
                   column("columns", &Measured::columns,
                          "columns of a mesh or torus; else the number of processors"),
                   column("links", &Measured::links, "links"),
                   column("degree_max", &Measured::degree_max, "most links of a processor"),
                   column("diameter", &Measured::diameter, "links between the farthest two"),
                   column("mean_distance", &Measured::mean_distance,
                          "links between two processors, on average over all ordered pairs"),
                   column("bisection", &Measured::bisection_width,
                          "fewest links between two halves; empty where it is not known")},
       .run = &run});
}

}  // namespace programs

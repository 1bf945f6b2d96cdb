// Distances in a network, for comparison with textbooks. Simulates nothing.
#include "topologies/graph/metrics.hpp"

#include "simulator/programs/declare/program.hpp"
#include "topologies/route/route_load.hpp"

namespace programs {

namespace metrics {

struct Params {};

// Rows and columns of a mesh or torus. Any other network counts as one row.
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
  const auto& topology = setup.topology;
  auto metrics = topologies::eval_metrics(topology);
  if (!setup.routes.is_shortest) {
    metrics.mean_distance = setup.routes.mean_distance();
    metrics.all_to_all = find_busiest(topology, eval_load(topology, setup.routes));
  }
  return Measured{metrics, grid_of(topology)};
}

}  // namespace metrics

Program make_metrics() {
  using namespace metrics;
  using M = Measured;
  return make_program<Params, M>(
      {.name = "metrics",
       .help = "distances of a network, for comparison with the literature; nothing is simulated",
       .uses = {.network = true, .routes = true},
       .columns =
           {column<M>("processors", &M::processors, "processors"),
            column<M>("rows", &M::rows, "rows of a mesh or torus; 1 for other networks"),
            column<M>("columns", &M::columns,
                      "columns of a mesh or torus; the number of processors for other networks"),
            column<M>("links", &M::links, "links"),
            column<M>("degree_max", &M::degree_max, "largest number of links of a processor"),
            column<M>("diameter", &M::diameter, "links between the two farthest processors"),
            column<M>("mean_distance", &M::mean_distance,
                      "mean number of links on a route, over all ordered pairs of processors"),
            column<M>(
                "busiest_link", [](const M& m) { return m.all_to_all.messages; },
                "messages over the busiest link direction if each processor sends one message to "
                "each other along the routes"),
            column<M>("bisection", &M::bisection_width,
                      "smallest number of links between two halves; empty if unknown")},
       .run = &run});
}

}  // namespace programs

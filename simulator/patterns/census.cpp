// No program at all: what each processor of a network has to do for others.
#include "simulator/patterns/pattern.hpp"

namespace patterns {

namespace {

using Around = std::vector<std::vector<topologies::Neighbour>>;

int next_of(const Setup& setup, const Around& around, int from, int to) {
  const int port = setup.routes.next_port(from, to);
  for (const auto& neighbour : around[static_cast<std::size_t>(from)])
    if (neighbour.port == port) return neighbour.processor;
  throw machine::InvariantBroken("a route leaves by a port without a link");
}

// Of each processor the ordered pairs of others whose route passes through it.
std::vector<int> count_routes_through(const Setup& setup, const Around& around) {
  std::vector<int> through(around.size());
  for (int from = 0; from < setup.topology.processors; ++from)
    for (int to = 0; to < setup.topology.processors; ++to) {
      if (from == to) continue;
      for (int at = next_of(setup, around, from, to); at != to; at = next_of(setup, around, at, to))
        ++through[static_cast<std::size_t>(at)];
    }
  return through;
}

Rows run(const Setup& setup) {
  const auto around = topologies::neighbours(setup.topology);
  const auto through = count_routes_through(setup, around);
  std::vector<Row> rows;
  for (std::size_t id = 0; id < around.size(); ++id) {
    double lower = 0;
    for (const auto& neighbour : around[id])
      if (neighbour.processor < static_cast<int>(id)) ++lower;
    rows.push_back(
        {{"processor", id}, {"routes_through", through[id]}, {"lower_neighbours", lower}});
  }
  return Rows(std::move(rows));
}

}  // namespace

Pattern make_census() {
  return {.name = "census",
          .help =
              "nothing runs: of each processor routes_through, the ordered pairs of others whose "
              "route passes through it, and lower_neighbours, those with a lower number",
          .uses_topology = true,
          .parameters = {},
          .run = &run,
          .parts = {"processor"},
          .uses_routes = true};
}

}  // namespace patterns

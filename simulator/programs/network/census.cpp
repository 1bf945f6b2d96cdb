// No program at all: what each processor of a network has to do for others.
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "simulator/declare/program.hpp"

namespace programs {

namespace {

using Around = std::vector<std::vector<topologies::Neighbour>>;

int next_of(const Setup& setup, const Around& around, int from, int to) {
  const int port = setup.routes.next_port(from, to);
  for (const auto& neighbour : around[from])
    if (neighbour.port == port) return neighbour.processor;
  throw base::InvariantBroken("a route leaves by a port without a link");
}

// Ordered pairs of processors, and those of them whose route passes through each other one.
struct Passed {
  std::vector<int> through;
  int pairs = 0;
};

Passed count_passed(const Setup& setup, const Around& around) {
  const int n = setup.topology.processors, root = setup.topology.root;
  const bool all = setup.choice("pairs") == "all";
  Passed passed{std::vector<int>(n), 0};
  for (int from = 0; from < n; ++from)
    for (int to = 0; to < n; ++to) {
      if (from == to || !(all || from == root || to == root)) continue;
      ++passed.pairs;
      for (int at = next_of(setup, around, from, to); at != to; at = next_of(setup, around, at, to))
        ++passed.through[at];
    }
  return passed;
}

// None where everybody is everybody's neighbour.
std::vector<std::string> describe_busiest(const Passed& passed) {
  const auto most = std::ranges::max_element(passed.through);
  if (*most == 0) return {};
  return {fmt::format("p{} is on the way of most routes, {} of {}", most - passed.through.begin(),
                      *most, passed.pairs)};
}

Rows run(const Setup& setup) {
  const auto around = topologies::neighbours(setup.topology);
  const auto passed = count_passed(setup, around);
  std::vector<Row> rows;
  for (int id = 0; id < setup.topology.processors; ++id) {
    const auto lower = std::ranges::count_if(
        around[id], [&](const auto& neighbour) { return neighbour.processor < id; });
    rows.push_back({{"processor", id},
                    {"routes_through", passed.through[id]},
                    {"lower_neighbours", static_cast<double>(lower)}});
  }
  return Rows(std::move(rows), describe_busiest(passed));
}

}  // namespace

Pattern make_census() {
  return {.name = "census",
          .help =
              "nothing runs: of each processor routes_through, the ordered pairs of others whose "
              "route passes through it, and lower_neighbours, those with a lower number",
          .uses_topology = true,
          .parameters = {make_choice("pairs", {"all", "root"},
                                     "who speaks with whom: all with all, or the root with all")},
          .run = &run,
          .parts = {"processor"},
          .uses_routes = true};
}

}  // namespace programs

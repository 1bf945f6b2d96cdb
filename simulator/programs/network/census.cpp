// Number of routes through each processor, computed from the routes of a network without
// simulation.

#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace census {

enum class Pairs { all, root };
const base::Names<Pairs> PAIRS = {{"all", Pairs::all}, {"root", Pairs::root}};

struct Params {
  Pairs pairs = Pairs::all;
};

// Work that a processor does for others: the number of routes through it, and the number of its
// neighbours with lower numbers.
struct Measured {
  base::Cell processor;
  int routes_through = 0, lower_neighbours = 0;
};

using Around = std::vector<std::vector<topologies::Neighbour>>;

int next_of(const Setup& setup, const Around& around, int from, int to) {
  const int port = setup.routes.next_port(from, to);
  for (const auto& neighbour : around[from])
    if (neighbour.port == port) return neighbour.processor;
  throw base::InvariantBroken("a route leaves by a port without a link");
}

// For each processor, the number of ordered pairs of other processors whose route passes through
// it; and the number of all pairs.
struct Passed {
  std::vector<int> through;
  int pairs = 0;
};

Passed count_passed(const Setup& setup, const Params& params, const Around& around) {
  const int n = setup.topology.processors, root = setup.topology.root;
  const bool all = params.pairs == Pairs::all;
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

// Makes a note that names the processor with the most routes through it. Makes none if there are no
// such routes, because all processors are neighbours.
std::vector<std::string> describe_busiest(const topologies::Topology& topology,
                                          const Passed& passed) {
  const auto most = std::ranges::max_element(passed.through);
  if (*most == 0) return {};
  const auto id = static_cast<int>(most - passed.through.begin());
  return {fmt::format("most routes pass through {}: {} of {}",
                      name_of(topology, id, fmt::format("p{}", id)), *most, passed.pairs)};
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto around = topologies::neighbours(setup.topology);
  const auto passed = count_passed(setup, params, around);
  std::vector<Measured> rows;
  for (int id = 0; id < setup.topology.processors; ++id) {
    const auto lower = std::ranges::count_if(
        around[id], [&](const auto& neighbour) { return neighbour.processor < id; });
    rows.push_back(
        {processor_cell(setup.topology, id), passed.through[id], static_cast<int>(lower)});
  }
  return Outcome<Measured>(std::move(rows), describe_busiest(setup.topology, passed));
}

}  // namespace census

Program make_census() {
  using namespace census;
  return make_program<Params, Measured>(
      {.name = "census",
       .help = "how many routes pass through each processor of a network; nothing is simulated",
       .uses = {.network = true, .routes = true},
       .fields = {base::Declare<Params>::choice(
           "pairs", &Params::pairs, PAIRS,
           "pairs that communicate: all pairs, or the root with every other processor")},
       .columns = {column("processor", &Measured::processor, "number or label"),
                   column("routes_through", &Measured::routes_through,
                          "ordered pairs of other processors whose route passes through this one"),
                   column("lower_neighbours", &Measured::lower_neighbours,
                          "neighbours with a lower number")},
       .parts = {"processor"},
       .run = &run});
}

}  // namespace programs

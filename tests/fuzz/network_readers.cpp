#include "base/errors.hpp"
#include "tests/fuzz/kinds.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/given_routes.hpp"

namespace fuzz {
namespace {

using topologies::Topology;

void expect_same_network(std::string_view what, const Topology& found, const Topology& expected) {
  expect_same(what, found.processors, expected.processors);
  expect_same(what, found.root, expected.root);
  expect_same(what, found.links, expected.links);
  expect_same(what, found.labels, expected.labels);
}

void expect_round_trips(const Topology& topology) {
  topologies::check(topology);
  // throws if a label cannot be written in the format
  const std::string graphml = to_graphml(topology), dot = to_dot(topology);
  const auto from_graphml = [&] { return topologies::read_graphml(graphml, "again.graphml"); };
  const auto from_dot = [&] { return topologies::read_dot(dot, "again.dot"); };
  expect_same_network("GraphML", read_again("GraphML", from_graphml), topology);
  expect_same_network("DOT", read_again("DOT", from_dot), topology);
}

// Throws unless each hop of each route is a link and leads one step nearer to the destination.
void expect_arrive(const Topology& topology, const topologies::RoutingTable& routes) {
  const auto around = neighbours(topology);
  for (int to = 0; to < topology.processors; ++to)
    for (int from = 0; from < topology.processors; ++from) {
      int at = from, hops = 0;
      while (at != to && hops <= topology.processors) {
        const int port = routes.next_port(at, to);
        int next = -1;
        for (const auto& neighbour : around[static_cast<std::size_t>(at)])
          if (neighbour.port == port) next = neighbour.processor;
        expect(next >= 0, "a route follows links");
        at = next;
        ++hops;
      }
      expect(at == to, "a route arrives");
      expect(hops == routes.distance(from, to), "a route is as long as its distance");
    }
}

void read_routes(const std::string& text) {
  static const Topology networks[] = {
      topologies::make_topology("ring:6"), topologies::make_topology("mesh:3x3"),
      topologies::load_topology(place_of("experiments/reference/figure-5.15.dot"))};
  int refused = 0;
  std::string why;
  for (const Topology& network : networks) try {
      expect_arrive(network, topologies::read_routes(network, text, "fuzz.csv"));
    } catch (const base::BadInput& error) {
      ++refused;
      why = error.what();
    }
  if (refused == std::ssize(networks)) throw base::BadInput(why);
}

}  // namespace

std::vector<Reader> network_readers() {
  return {
      {"dot",
       ".dot",
       {"experiments/reference"},
       [](const auto& text) { expect_round_trips(topologies::read_dot(text, "fuzz.dot")); }},
      {"graphml",
       ".graphml",
       {},
       [](const auto& text) {
         expect_round_trips(topologies::read_graphml(text, "fuzz.graphml"));
       }},
      {"routes", "-routes.csv", {"experiments/reference"}, read_routes},
  };
}

}  // namespace fuzz

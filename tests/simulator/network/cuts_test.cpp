// Routes of the acyclic router after cuts of links, compared with an independent wait-for graph.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "simulator/network/routing.hpp"
#include "tests/simulator/network/router_support.hpp"

namespace network {
namespace {

using Way = std::pair<int, int>;  // a processor, and a port where a message leaves it
using Waits = std::map<Way, std::set<Way>>;

// Adds all routes to the graph: a message that holds one link of its route waits for the next one.
void add_routes(const Routing& routing, Waits& waits) {
  for (int to = 0; to < routing.processors(); ++to) {
    const auto distance = topologies::plain_distances(routing.topology(), to);
    for (int from = 0; from < routing.processors(); ++from) {
      ASSERT_EQ(routing.port_to(from, to) < 0, from == to || distance[from] < 0);
      std::optional<Way> before;
      int links = 0;
      for (int at = from; routing.port_to(at, to) >= 0; ++links) {
        ASSERT_LT(links, routing.processors()) << from << " to " << to;
        const Way way{at, routing.port_to(at, to)};
        if (before) waits[*before].insert(way);
        before = way;
        at = routing.neighbour(way.first, way.second);
      }
      ASSERT_EQ(links, std::max(0, routing.distance(from, to)));
    }
  }
}

// Adds broadcasts to the graph: a broadcast waits for every link over which a processor passes it
// on. Also checks that a broadcast reaches every processor.
void add_messages_to_all(const Routing& routing, Waits& waits) {
  const auto epoch = routing.epoch();
  for (int sender = 0; sender < routing.processors(); ++sender) {
    const auto reached = routing.below(epoch, sender, sender);
    const auto distance = topologies::plain_distances(routing.topology(), sender);
    ASSERT_EQ(static_cast<long>(reached.size()),
              routing.processors() - std::ranges::count(distance, -1));
    for (const int at : reached)
      for (const int port : routing.tree_ports(epoch, sender, at)) {
        const int next = routing.neighbour(at, port);
        for (const int on : routing.tree_ports(epoch, sender, next))
          waits[{at, port}].insert({next, on});
      }
  }
}

// Repeatedly removes the entries that wait for nothing. There is a cycle if some entries remain and
// none of them can be removed.
bool has_cycle(Waits waits) {
  for (bool is_smaller = true; is_smaller;) {
    const auto waits_for_nothing = [&](const auto& entry) {
      return std::ranges::none_of(entry.second, [&](Way way) { return waits.contains(way); });
    };
    std::set<Way> done;
    for (const auto& entry : waits)
      if (waits_for_nothing(entry)) done.insert(entry.first);
    for (const Way& way : done) waits.erase(way);
    is_smaller = !done.empty();
  }
  return !waits.empty();
}

bool closes_cycle_here(const Routing& routing) {
  Waits waits;
  add_routes(routing, waits);
  add_messages_to_all(routing, waits);
  return has_cycle(std::move(waits));
}

void cut_at_random(const topologies::Topology& topology, unsigned seed) {
  std::mt19937 random(seed);
  auto routing = make_acyclic_routing(topology, topologies::make_routes(topology));
  ASSERT_FALSE(closes_cycle_here(routing));
  for (auto left = topology.links.size(); left > topology.links.size() / 3;) {
    const auto link = routing.topology().links[random() % left];
    const int a = link.a.processor, b = link.b.processor;
    const auto joins = [&](const topologies::Link& other) {
      return other.a.processor == a && other.b.processor == b;
    };
    left -= static_cast<std::size_t>(std::ranges::count_if(routing.topology().links, joins));
    routing.cut(a, b);
    ASSERT_EQ(routing.topology().links.size(), left);
    ASSERT_EQ(std::ranges::count_if(routing.topology().links, joins), 0);
    ASSERT_FALSE(closes_cycle_here(routing)) << left << " links are left";
  }
}

TEST(AcyclicCuts, NoRoutesCloseACycleOfWaitingLinks) {
  for (const char* spec : {"ring:9", "mesh:4x4", "torus:4x4", "torus:5x3", "hypercube:4", "amp:9"})
    for (unsigned seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(fmt::format("{}, seed {}", spec, seed));
      cut_at_random(topologies::make_topology(spec), seed);
    }
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(fmt::format("random, seed {}", seed));
    cut_at_random(random_topology(seed, 20), seed);
  }
}

// The wait-for graph must find the cycles that shortest routes close.
TEST(AcyclicCuts, ShortestRoutesDoCloseSome) {
  const auto closes = [](const char* spec) {
    const auto topology = topologies::make_topology(spec);
    return closes_cycle_here({topology, topologies::make_routes(topology)});
  };
  EXPECT_TRUE(closes("ring:9"));
  EXPECT_TRUE(closes("torus:4x4"));
  EXPECT_FALSE(closes("line:9"));
}

}  // namespace
}  // namespace network

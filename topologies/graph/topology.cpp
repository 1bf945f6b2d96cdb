#include "topologies/graph/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "base/errors.hpp"
#include "topologies/graph/search.hpp"

namespace topologies {

std::vector<std::vector<Neighbour>> neighbours(const Topology& topology) {
  std::vector<std::vector<Neighbour>> result(topology.processors);
  for (int i = 0; i < static_cast<int>(topology.links.size()); ++i) {
    const auto& [a, b] = topology.links[i];
    result[a.processor].push_back({a.port, b.processor, b.port, i});
    result[b.processor].push_back({b.port, a.processor, a.port, i});
  }
  for (auto& around : result) std::ranges::sort(around, {}, &Neighbour::port);
  return result;
}

namespace {

auto place_of_link(const Link& link) {
  return std::tuple(link.a.processor, link.b.processor, link.a.port);
}

}  // namespace

void sort_links(Topology& topology) { std::ranges::sort(topology.links, {}, place_of_link); }

std::vector<Link> distinct_links(const Topology& topology) {
  auto links = topology.links;
  const auto same = [](const Link& one, const Link& other) {
    return one.a.processor == other.a.processor && one.b.processor == other.b.processor;
  };
  links.erase(std::unique(links.begin(), links.end(), same), links.end());
  return links;
}

std::vector<std::array<std::int8_t, PORTS>> parallel_ports(const Topology& topology) {
  const auto peers = make_peers(topology);
  std::vector<std::array<std::int8_t, PORTS>> next(peers.size());
  for (std::size_t p = 0; p < peers.size(); ++p)
    for (int port = 0; port < PORTS; ++port) {
      int other = (port + 1) % PORTS;
      const bool is_free = peers[p][port] == static_cast<int>(p);
      while (!is_free && peers[p][other] != peers[p][port]) other = (other + 1) % PORTS;
      next[p][port] = static_cast<std::int8_t>(is_free ? port : other);
    }
  return next;
}

Peers make_peers(const Topology& topology) {
  Peers peers(topology.processors);
  for (int p = 0; p < topology.processors; ++p) peers[p].fill(p);
  for (const auto& [a, b] : topology.links) {
    peers[a.processor][a.port] = b.processor;
    peers[b.processor][b.port] = a.processor;
  }
  return peers;
}

int switches_between(const Topology& topology, int a, int b) {
  const auto found = topology.switches.find(std::minmax(a, b));
  return found == topology.switches.end() ? 0 : found->second;
}

int free_port(const Topology& topology, int processor) {
  std::array<bool, PORTS> used{};
  for (const auto& [a, b] : topology.links) {
    if (a.processor == processor) used.at(a.port) = true;
    if (b.processor == processor) used.at(b.port) = true;
  }
  const auto found = std::ranges::find(used, false);
  return found == used.end() ? -1 : static_cast<int>(found - used.begin());
}

std::string name_of(const Topology& topology, int processor, std::string otherwise) {
  return topology.labels.empty() ? std::move(otherwise) : topology.labels.at(processor);
}

std::string describe_processor(const Topology& topology, int processor) {
  if (processor < 0 || processor >= static_cast<int>(topology.labels.size()))
    return fmt::format("{}", processor);
  return fmt::format("\"{}\"", topology.labels[processor]);
}

namespace {

using base::require;

// The start of messages about a topology.
std::string place_of(const Topology& t) { return "topology " + t.name; }

void check_ends(const Topology& t) {
  const std::string place = place_of(t);
  for (const auto& [a, b] : t.links) {
    for (const End& end : {a, b})
      require(end.processor >= 0 && end.processor < t.processors, place,
              "found a link that ends at processor {}, expected 0 to {}", end.processor,
              t.processors - 1);
    require(a.processor != b.processor, place,
            "found a link from processor {} to itself, expected two processors",
            describe_processor(t, a.processor));
    require(a.processor < b.processor, place,
            "found a link from processor {} to {}, expected the lower number first", a.processor,
            b.processor);
  }
}

void check_order(const Topology& t) {
  const std::string place = place_of(t);
  for (size_t i = 1; i < t.links.size(); ++i) {
    require(place_of_link(t.links[i - 1]) <= place_of_link(t.links[i]), place,
            "found links {} and {} in the wrong order", i - 1, i);
  }
}

void check_ports(const Topology& t) {
  const std::string place = place_of(t);
  std::vector<int> degree(t.processors, 0);
  std::vector<std::array<int, PORTS>> peer(t.processors, {-1, -1, -1, -1});
  for (const auto& [a, b] : t.links) ++degree[a.processor], ++degree[b.processor];
  for (int p = 0; p < t.processors; ++p)
    require(degree[p] <= PORTS, place,
            "found {1} links of processor {0}, expected at most {2}, the ports of a transputer",
            describe_processor(t, p), degree[p], PORTS);
  for (const auto& link : t.links)
    for (const auto& [end, other] : {std::pair(link.a, link.b), std::pair(link.b, link.a)}) {
      const auto name = [&](int processor) { return describe_processor(t, processor); };
      require(end.port >= 0 && end.port < PORTS, place,
              "found the link of processor {} to {} on port {}, expected 0 to {}",
              name(end.processor), name(other.processor), end.port, PORTS - 1);
      int& taken = peer[end.processor][end.port];
      require(taken < 0, place,
              "found port {} of processor {} wired to both {} and {}, expected one link", end.port,
              name(end.processor), name(taken), name(other.processor));
      taken = other.processor;
    }
}

void check_connected(const Topology& t) {
  const auto distance = make_search(t, t.root).distance;
  const auto lost = std::ranges::find(distance, -1) - distance.begin();
  require(lost == t.processors, place_of(t),
          "found no path from the root {1} to processor {0}, expected a connected network",
          describe_processor(t, static_cast<int>(lost)), describe_processor(t, t.root));
}

}  // namespace

void check(const Topology& topology) {
  const Topology& t = topology;
  const std::string place = place_of(t);
  require(t.processors >= 1, place, "found no processors, expected at least one");
  require(t.processors <= MAX_PROCESSORS, place, "found {} processors, expected at most {}",
          t.processors, MAX_PROCESSORS);
  require(t.root >= 0 && t.root < t.processors, place, "found root {}, expected 0 to {}", t.root,
          t.processors - 1);
  require(t.labels.empty() || static_cast<int>(t.labels.size()) == t.processors, place,
          "found {} labels, expected {}, one for each processor", t.labels.size(), t.processors);
  check_ends(t);
  check_order(t);
  check_ports(t);
  check_connected(t);
}

}  // namespace topologies

// Topologies for tests: a list of specifications, random topologies, and a simple search.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "topologies/graph/topology.hpp"

namespace topologies {

inline const std::vector<std::string> SPECS{
    "line:1",      "line:2",      "line:3",    "line:9",      "line:40",     "ring:3",
    "ring:4",      "ring:9",      "ring:32",   "tree:1",      "tree:2",      "tree:5",
    "tree:7",      "tree:13",     "tree:40",   "tree:100",    "tree:6:1",    "tree:2:2",
    "tree:31:2",   "tree:50:2",   "mesh:1x1",  "mesh:1x6",    "mesh:6x1",    "mesh:2x2",
    "mesh:2x3",    "mesh:3x3",    "mesh:5x4",  "mesh:8x8",    "torus:3x3",   "torus:3x4",
    "torus:5x3",   "torus:4x4",   "torus:7x8", "hypercube:0", "hypercube:1", "hypercube:2",
    "hypercube:3", "hypercube:4", "star:1",    "star:2",      "star:4",      "star:5",
    "torus:1x1",   "torus:1x2",   "torus:2x1", "torus:2x2",   "torus:2x5",   "torus:4x2",
    "torus:6x1",   "torus:1x7",   "binary:1",  "binary:10",   "binary:31",   "amp:1",
    "amp:2",       "amp:3",       "amp:4",     "amp:5",       "amp:6",       "amp:7",
    "amp:8",       "amp:9",       "amp:23",    "amp:64",      "amp:100"};

// Names each test after its topology: the test of "mesh:5x4" is named mesh_5x4.
struct SpecName {
  std::string operator()(const testing::TestParamInfo<std::string>& info) const {
    auto name = info.param;
    std::ranges::replace_if(
        name, [](char c) { return !std::isalnum(c); }, '_');
    return name;
  }
};

// The number of links from `start` to each processor, computed without Boost and `neighbours`.
inline std::vector<int> plain_distances(const Topology& t, int start) {
  std::vector<int> distance(t.processors, -1);
  distance[start] = 0;
  for (std::deque<int> queue{start}; !queue.empty(); queue.pop_front())
    for (const auto& [a, b] : t.links)
      for (const auto& [here, there] :
           {std::pair(a.processor, b.processor), std::pair(b.processor, a.processor)})
        if (here == queue.front() && distance[there] < 0) {
          distance[there] = distance[here] + 1;
          queue.push_back(there);
        }
  return distance;
}

// A connected random tree with some extra links on random ports, at most four links per processor.
// For odd seeds, some pairs of processors are joined by several links.
inline Topology random_topology(unsigned seed, int largest = 31) {
  std::mt19937 random(seed);
  const auto below = [&](size_t n) { return static_cast<int>(random() % n); };
  Topology t{"random", 2 + below(static_cast<size_t>(largest - 1)), 0, {}, {}, {}};
  t.root = below(t.processors);
  std::vector<std::vector<int>> ports(t.processors, {0, 1, 2, 3});
  for (auto& p : ports) std::ranges::shuffle(p, random);
  const auto link = [&](int a, int b) {
    const bool linked = std::ranges::any_of(
        t.links, [&](auto& l) { return l.a.processor == a && l.b.processor == b; });
    // A parallel link must leave a free port.
    const auto few = linked ? (seed % 2 == 0 ? 4u : 1u) : 0u;
    if (a >= b || ports[a].size() <= few || ports[b].size() <= few) return false;
    t.links.push_back({{a, ports[a].back()}, {b, ports[b].back()}});
    ports[a].pop_back(), ports[b].pop_back();
    return true;
  };
  for (int p = 1; p < t.processors; ++p)
    while (!link(below(p), p)) continue;
  for (int extra = below(40); extra > 0; --extra) link(below(t.processors), below(t.processors));
  sort_links(t);
  return t;
}

// Permutes the four ports of each processor at random.
inline void shuffle_ports(Topology& t, std::mt19937& random) {
  std::vector<std::vector<int>> ports(t.processors, {0, 1, 2, 3});
  for (auto& p : ports) std::ranges::shuffle(p, random);
  for (auto& link : t.links)
    for (End* end : {&link.a, &link.b}) end->port = ports[end->processor][end->port];
}

// Adds the processors of `other` to `t`, and a link between the two if both have a free port.
inline void append(Topology& t, const Topology& other) {
  const int first = t.processors;
  int at = first - 1, there = 0;
  while (free_port(t, at) < 0) --at;
  while (there < other.processors && free_port(other, there) < 0) ++there;
  if (there == other.processors) return;
  t.links.push_back({{at, free_port(t, at)}, {first + there, free_port(other, there)}});
  for (const auto& [a, b] : other.links)
    t.links.push_back({{first + a.processor, a.port}, {first + b.processor, b.port}});
  t.processors += other.processors;
  sort_links(t);
}

// The message of the BadInput that `act` throws, or "" if it throws none.
template <typename Act>
std::string rejection(Act act) {
  try {
    act();
  } catch (const base::BadInput& error) {
    return error.what();
  }
  return "";
}

// A temporary file, deleted by the destructor.
struct TemporaryFile {
  TemporaryFile(const std::string& name, const std::string& text)
      : path(testing::TempDir() + "tlab-" + std::to_string(getpid()) + "-" + name) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  std::string path;
};

}  // namespace topologies

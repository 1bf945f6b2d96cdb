#include "topologies/graph/all_pairs.hpp"

#include <algorithm>
#include <limits>
#include <thread>

#include "topologies/graph/grid.hpp"
#include "topologies/graph/search.hpp"

namespace topologies {
namespace {

// A processor or a distance in two bytes, so that the data of a search fits into the cache.
using Short = std::uint16_t;
static_assert(MAX_PROCESSORS - 1 <= std::numeric_limits<Short>::max());
using ShortPeers = std::vector<std::array<Short, PORTS>>;

ShortPeers make_short_peers(const Topology& topology) {
  ShortPeers peers(topology.processors);
  std::ranges::transform(make_peers(topology), peers.begin(), [](const auto& of) {
    std::array<Short, PORTS> to{};
    std::ranges::transform(of, to.begin(), [](int p) { return static_cast<Short>(p); });
    return to;
  });
  return peers;
}

// Breadth-first search from one processor, the start. Also finds the port by which each processor
// sends towards the start: the lowest port to a neighbour that is one link nearer, as in the
// routing table.
class Gathering {
 public:
  explicit Gathering(const ShortPeers& peers)
      : peers_(peers),
        distance_(peers.size()),
        order_(peers.size() + 1),
        port_(peers.size()),
        forwarded_(peers.size()) {}

  // Must not be used for trees. In any other connected topology, all distances are below UNSEEN.
  void search(int to) {
    std::ranges::fill(distance_, UNSEEN);
    Short* const distance = distance_.data();
    Short* const order = order_.data();
    distance[to] = 0;
    order[0] = static_cast<Short>(to);
    std::size_t found = 1;
    for (std::size_t i = 0; i < found; ++i) {
      const int p = order[i], here = distance[p];
      const auto& peers = peers_[p];
      int back = 0;
      // The loop has no branches, because the host's CPU could not predict them.
      for (int port = PORTS - 1; port >= 0; --port) {
        const Short peer = peers[port], there = distance[peer];
        back = there < here ? port : back;
        order[found] = peer;
        found += there == UNSEEN;
        distance[peer] = static_cast<Short>(std::min<int>(there, here + 1));
      }
      port_[p] = static_cast<std::uint8_t>(back);
      sum_ += here;
    }
    longest_ = std::max<int>(longest_, distance[order[found - 1]]);
  }

  // Sends one message from every processor to the start of the last search. Adds up the messages
  // sent through each port, per orbit of equivalent processors. Visits the farthest processors
  // first, so that each count is complete before its messages are forwarded.
  void add_messages(const Orbits& orbits) {
    sent_.resize(static_cast<std::size_t>(orbits.count()) * PORTS);
    std::ranges::fill(forwarded_, 1);
    const int n = static_cast<int>(peers_.size());
    for (int i = n - 1; i > 0; --i) {
      const int p = order_[i];
      forwarded_[peers_[p][port_[p]]] += forwarded_[p];
    }
    forwarded_[order_[0]] = 0;
    if (orbits.count() == n)
      for (int p = 0; p < n; ++p) sent_[p * PORTS + port_[p]] += forwarded_[p];
    else
      for (int p = 0; p < n; ++p) sent_[orbits.orbit_of(p) * PORTS + port_[p]] += forwarded_[p];
  }

  Distances distances() const { return {sum_, longest_}; }
  const Sent& sent() const { return sent_; }

 private:
  static constexpr Short UNSEEN = std::numeric_limits<Short>::max();

  const ShortPeers& peers_;
  std::vector<Short> distance_, order_;
  std::vector<std::uint8_t> port_;
  std::vector<int> forwarded_;
  std::int64_t sum_ = 0;
  int longest_ = 0;
  Sent sent_;
};

// Runs one search from one processor of each orbit, on all cores of the host. The sums are integers
// and therefore independent of the order in which threads finish.
template <typename Visit>
std::vector<Gathering> search_orbits(const ShortPeers& peers, const Orbits& orbits, Visit visit) {
  constexpr std::int64_t LEAST = 1 << 22;  // minimum number of pairs per thread
  const std::int64_t pairs = static_cast<std::int64_t>(peers.size()) * orbits.count();
  const std::int64_t cores = std::max(1u, std::thread::hardware_concurrency());
  const int parts = static_cast<int>(std::clamp<std::int64_t>(pairs / LEAST, 1, cores));
  std::vector<Gathering> gatherings(parts, Gathering(peers));
  const auto work = [&](int part) {
    for (int orbit = part; orbit < orbits.count(); orbit += parts) {
      gatherings[part].search(orbits.first_of(orbit));
      visit(gatherings[part]);
    }
  };
  {
    std::vector<std::jthread> others;
    for (int part = 1; part < parts; ++part) others.emplace_back(work, part);
    work(0);
  }
  return gatherings;
}

Distances add_distances(const Topology& topology, const Orbits& orbits,
                        const std::vector<Gathering>& gatherings) {
  Distances all;
  for (const auto& gathering : gatherings) {
    const auto [sum, longest] = gathering.distances();
    all.sum += sum * (topology.processors / orbits.count());
    all.longest = std::max(all.longest, longest);
  }
  return all;
}

AllPairs search_all_pairs(const Topology& topology) {
  const auto peers = make_short_peers(topology);
  const auto orbits = find_orbits(topology);
  const auto gatherings =
      search_orbits(peers, orbits, [&](Gathering& gathering) { gathering.add_messages(orbits); });
  Sent sent(peers.size() * PORTS);
  for (int p = 0; p < topology.processors; ++p)
    for (int port = 0; port < PORTS; ++port)
      for (const auto& gathering : gatherings)
        sent[p * PORTS + port] += gathering.sent()[orbits.orbit_of(p) * PORTS + port];
  return {add_distances(topology, orbits, gatherings), make_load(topology, sent)};
}

// Measures a tree. A link of a tree separates two sets of processors and carries one message for
// every ordered pair with one processor in each set.
AllPairs eval_tree(const Topology& topology) {
  const std::int64_t n = topology.processors;
  const auto search = make_search(topology, topology.root);
  std::vector<std::int64_t> below(topology.processors, 1);
  for (auto p = search.order.rbegin(); *p != topology.root; ++p)
    below[search.parent[*p]] += below[*p];
  AllPairs all;
  for (const auto& [a, b] : topology.links) {
    const auto lower = search.parent[a.processor] == b.processor ? a.processor : b.processor;
    const auto pairs = below[lower] * (n - below[lower]);
    all.load.push_back({pairs, pairs});
    all.distances.sum += 2 * pairs;
  }
  const auto farthest = make_search(topology, search.order.back());
  all.distances.longest = farthest.distance[farthest.order.back()];
  return all;
}

// True if the ports follow the convention for meshes: 0 north, 1 west, 2 east, 3 south.
bool has_ports_of_mesh(const Topology& topology, const Grid& grid) {
  if (grid.down.closed || grid.along.closed) return false;
  return std::ranges::all_of(topology.links, [&](const Link& link) {
    const bool is_south = link.b.processor - link.a.processor == grid.along.size;
    return is_south ? link.a.port == 3 && link.b.port == 0 : link.a.port == 2 && link.b.port == 1;
  });
}

// Measures a mesh. A message takes the lowest suitable port: first north along the source's column,
// then along the row, then south along the destination's column.
AllPairs eval_mesh(const Topology& topology, const Grid& grid) {
  const std::int64_t rows = grid.down.size, columns = grid.along.size;
  AllPairs all{{grid.sum_of_distances(), grid.diameter()}, {}};
  for (const auto& [a, b] : topology.links) {
    const std::int64_t row = a.processor / columns, column = a.processor % columns;
    const std::int64_t above = row + 1, below = rows - above, left = column + 1;
    // north-south link: for messages between a processor of any row above and one below in the same
    // column
    if (a.port == 3)
      all.load.push_back({above * below * columns, below * above * columns});
    else  // east-west link: along the row of the source or of the destination
      all.load.push_back({(below + below + 1) * left * (columns - left),
                          (below + below + 1) * left * (columns - left)});
  }
  return all;
}

}  // namespace

Load make_load(const Topology& topology, const Sent& sent) {
  const auto parallel = parallel_ports(topology);
  // The messages that a processor sends to a neighbour over one of several parallel links. `sum`
  // counts the messages over all of them. `turn` is the rank of this link, by ascending port.
  const auto at = [&](const End& end) {
    const auto& next = parallel[end.processor];
    std::int64_t sum = 0, count = 0, turn = 0;
    for (int port = end.port; count == 0 || port != end.port; port = next[port]) {
      sum += sent[static_cast<std::size_t>(end.processor) * PORTS + port];
      turn += port < end.port;
      ++count;
    }
    return (sum + count - 1 - turn) / count;
  };
  Load load;
  load.reserve(topology.links.size());
  for (const auto& [a, b] : topology.links) load.push_back({at(a), at(b)});
  return load;
}

AllPairs eval_all_pairs(const Topology& topology) {
  if (is_tree(topology)) return eval_tree(topology);
  const auto grid = find_grid(topology);
  if (grid && has_ports_of_mesh(topology, *grid)) return eval_mesh(topology, *grid);
  return search_all_pairs(topology);
}

Distances eval_distances(const Topology& topology) {
  if (is_tree(topology)) return eval_tree(topology).distances;
  if (const auto grid = find_grid(topology)) return {grid->sum_of_distances(), grid->diameter()};
  const auto peers = make_short_peers(topology);
  const auto orbits = find_orbits(topology);
  return add_distances(topology, orbits, search_orbits(peers, orbits, [](const Gathering&) {}));
}

double eval_mean_distance(const Topology& topology) {
  const std::int64_t n = topology.processors;
  const auto sum = static_cast<double>(eval_distances(topology).sum);
  return n > 1 ? sum / static_cast<double>(n * (n - 1)) : 0;
}

}  // namespace topologies

#include "topologies/graph/bisection.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "base/errors.hpp"
#include "topologies/graph/search.hpp"

namespace topologies {
namespace {

using Set = std::uint32_t;

// Branch and bound search for the minimum number of cut links. Assigns processors to two sides one
// by one, in breadth-first order from the root. Backtracks if the links already cut, plus a lower
// bound on further cuts, are not fewer than in the best solution so far.
class Halves {
 public:
  explicit Halves(const Topology& topology)
      : count_(topology.processors), larger_((topology.processors + 1) / 2) {
    const auto search = make_search(topology, topology.root);
    std::array<int, MOST_BISECTED> place{};
    for (int i = 0; i < count_; ++i) place[static_cast<std::size_t>(search.order[i])] = i;
    for (const auto& [a, b] : topology.links) {
      const auto from = place[static_cast<std::size_t>(a.processor)];
      const auto to = place[static_cast<std::size_t>(b.processor)];
      links_[from].push_back(to);
      links_[to].push_back(from);
    }
    fewest_ = static_cast<int>(topology.links.size()) + 1;
  }

  int find() {
    put(0, {}, 0);
    return fewest_;
  }

 private:
  int count_links(int of, Set into) const {
    return static_cast<int>(
        std::ranges::count_if(links_[of], [&](int other) { return (into >> other & 1U) != 0; }));
  }

  // A lower bound on the number of links that will be cut by later assignments. The bound adds, for
  // each unassigned processor, its links to the side to which it has fewer links.
  int bound(int next, const std::array<Set, 2>& sides) const {
    int least = 0;
    for (int rest = next; rest < count_; ++rest)
      least += std::min(count_links(rest, sides[0]), count_links(rest, sides[1]));
    return least;
  }

  void put(int next, const std::array<Set, 2>& sides, int cut) {
    if (next == count_) {
      fewest_ = std::min(fewest_, cut);
      return;
    }
    if (cut + bound(next, sides) >= fewest_) return;
    const int cut_on_first = count_links(next, sides[1]),
              cut_on_second = count_links(next, sides[0]);
    const int better = cut_on_second < cut_on_first ? 1 : 0;
    for (const int side : {better, 1 - better}) {
      if (std::popcount(sides[side]) == larger_) continue;
      if (next == 0 && side == 1) continue;  // by symmetry, the first processor is always on side 0
      auto grown = sides;
      grown[side] |= Set{1} << next;
      put(next + 1, grown, cut + (side == 0 ? cut_on_first : cut_on_second));
    }
  }

  int count_, larger_, fewest_ = 0;
  // The neighbours of each processor. Numbers of processors are their positions in the
  // breadth-first order.
  std::array<std::vector<int>, MOST_BISECTED> links_;
};

}  // namespace

int eval_bisection(const Topology& topology) {
  base::require(topology.processors <= MOST_BISECTED, topology.name,
                "found {} processors, expected at most {}", topology.processors, MOST_BISECTED);
  return Halves(topology).find();
}

}  // namespace topologies

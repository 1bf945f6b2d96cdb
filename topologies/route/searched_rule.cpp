#include "topologies/route/searched_rule.hpp"

#include <algorithm>
#include <bit>

#include "topologies/graph/search.hpp"

namespace topologies {

// State of the simultaneous searches from a group of destinations. Each step extends all searches
// by one link.
struct SearchedRule::Work {
  std::vector<Word> met;   // by processor: set of destinations whose search has arrived
  std::vector<Word> news;  // by processor: set of destinations whose search arrives in this step
  std::vector<int> seen;   // by processor: step in which it was last examined
  std::vector<int> active, next;  // processors reached in the previous step, and in this step
  int step = 0;
};

SearchedRule::SearchedRule(const Topology& topology)
    : Rule(topology),
      piece_(topology.processors),
      finds_((topology.processors + GROUP - 1) / GROUP) {
  for_each_piece(topology, [&](int start, const Search& search) {
    for (const int p : search.order) piece_[p] = start;
    is_whole_ = static_cast<int>(search.order.size()) == topology.processors;
  });
  found_.resize(groups());
}

// Extends all searches by one link. A search reaches a processor if it has already reached a
// neighbour of the processor. That neighbour is one link nearer to the destination.
void SearchedRule::add_step(const Peers& peers, Work& work, Routes& routes) {
  ++work.step;
  work.next.clear();
  const auto look = [&](int p) {
    if (work.seen[p] == work.step) return;
    work.seen[p] = work.step;
    Word left = 0;
    for (const int peer : peers[p]) left |= work.met[peer];
    left &= ~work.met[p];
    if (left == 0) return;
    work.news[p] = left;
    work.next.push_back(p);
    for (unsigned port = 0; port < PORTS; ++port) {
      const Word here = left & work.met[peers[p][port]];
      for (unsigned bit = 0; bit < 2; ++bit)
        if (port >> bit & 1U) routes.port[p][bit] |= here;
      left &= ~here;
    }
  };
  for (const int p : work.active)
    for (const int peer : peers[p]) look(peer);
  for (const int p : work.next) {
    work.met[p] |= work.news[p];
    const std::int64_t pairs = std::popcount(work.news[p]);
    routes.sum += {work.step * pairs, pairs};
  }
  std::swap(work.active, work.next);
}

SearchedRule::Routes SearchedRule::find_routes(int group) const {
  const std::size_t n = peers().size();
  Routes routes{std::vector<std::array<Word, 2>>(n), {}};
  Work work{std::vector<Word>(n), std::vector<Word>(n), std::vector<int>(n), {}, {}};
  for (int end = 0; end < GROUP && group * GROUP + end < processors(); ++end) {
    work.met[group * GROUP + end] = Word{1} << end;
    work.active.push_back(group * GROUP + end);
  }
  while (!work.active.empty()) add_step(peers(), work, routes);
  return routes;
}

int SearchedRule::next_port(int from, int to) const {
  if (piece_[from] != piece_[to]) return -1;
  const int group = to / GROUP;
  auto& routes = found_[group];
  std::call_once(finds_[group],
                 [&] { routes = std::make_unique<const Routes>(find_routes(group)); });
  const auto& [low, high] = routes->port[from];
  return static_cast<int>((low >> (to % GROUP) & 1U) | (high >> (to % GROUP) & 1U) << 1U);
}

RouteSum SearchedRule::sum() const {
  RouteSum sum;
  for (int group = 0; group < groups(); ++group)
    sum += found_[group] ? found_[group]->sum : find_routes(group).sum;
  return sum;
}

SearchedRule::Word SearchedRule::ends_reached(int from, int group) const {
  const int first = group * GROUP, count = std::min(GROUP, processors() - first);
  Word ends = ~Word{0} >> (GROUP - count);
  if (from >= first && from < first + count) ends &= ~(Word{1} << (from - first));
  if (is_whole_) return ends;
  for (int end = 0; end < count; ++end)
    if (piece_[first + end] != piece_[from]) ends &= ~(Word{1} << end);
  return ends;
}

void SearchedRule::add_turns(Turns& turns, int first, int last) const {
  for (int group = first / GROUP; group * GROUP < last; ++group) {
    const auto routes = find_routes(group);
    // For each processor and port: the set of destinations whose routes take this port.
    std::vector<std::array<Word, PORTS>> led(peers().size());
    for (int p = 0; p < processors(); ++p) {
      const auto [low, high] = routes.port[p];
      const Word ends = ends_reached(p, group);
      led[p] = {ends & ~low & ~high, ends & low & ~high, ends & ~low & high, ends & low & high};
    }
    for (int p = 0; p < processors(); ++p)
      for (int port = 0; port < PORTS; ++port)
        for (int next = 0; next < PORTS; ++next)
          if (led[p][port] & led[peers()[p][port]][next])
            turns[p * PORTS + port] |= static_cast<std::uint8_t>(1U << next);
  }
}

}  // namespace topologies

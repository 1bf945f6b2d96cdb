#include "topologies/route/rule.hpp"

namespace topologies {

int Rule::distance(int from, int to) const {
  int links = 0;
  for (int at = from; at != to; ++links) {
    const int port = next_port(at, to);
    if (port < 0) return -1;
    at = peers_[at][port];
  }
  return links;
}

RouteSum Rule::sum_to(int to) const {
  constexpr int UNKNOWN = -2, NO_WAY = -1;
  std::vector<int> links(peers_.size(), UNKNOWN), next(peers_.size()), way;
  links[to] = 0;
  RouteSum sum;
  for (int from = 0; from < processors(); ++from) {
    for (int at = from; links[at] == UNKNOWN; at = next[at]) {
      const int port = next_port(at, to);
      if (port < 0) {
        links[at] = NO_WAY;
        break;
      }
      next[at] = peers_[at][port];
      way.push_back(at);
    }
    for (; !way.empty(); way.pop_back()) {
      const int rest = links[next[way.back()]];
      links[way.back()] = rest < 0 ? NO_WAY : rest + 1;
    }
    if (links[from] > 0) sum += {links[from], 1};
  }
  return sum;
}

RouteSum Rule::sum() const {
  RouteSum sum;
  for (int to = 0; to < processors(); ++to) sum += sum_to(to);
  return sum;
}

void Rule::add_turns(Turns& turns, int first, int last) const {
  for (int to = first; to < last; ++to)
    for (int at = 0; at < processors(); ++at) {
      if (at == to) continue;
      const int port = next_port(at, to);
      if (port < 0 || peers_[at][port] == to) continue;
      turns[at * PORTS + port] |= 1U << next_port(peers_[at][port], to);
    }
}

}  // namespace topologies

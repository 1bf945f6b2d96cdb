// A topology of one's own: a ladder of two rails and N rungs. It is made in memory, checked and
// measured.
#include <fmt/format.h>

#include <cstdlib>

#include "topologies/graph/metrics.hpp"

using topologies::Topology;

//   0 1---2 2 1---2 4        rung r joins the processors 2r and 2r + 1 by their ports 3;
//   3       3       3        the rails run on ports 1 (towards higher rungs) and 2;
//   |       |       |        port 0 is free everywhere, for a coordinator
//   3       3       3
//   1 1---2 3 1---2 5
Topology make_ladder(int rungs) {
  Topology t;
  t.name = fmt::format("ladder:{}", rungs);
  t.processors = 2 * rungs;
  for (int p = 0; p < t.processors; ++p) {
    if (p % 2 == 0) t.links.push_back({{p, 3}, {p + 1, 3}});
    if (p + 2 < t.processors) t.links.push_back({{p, 1}, {p + 2, 2}});
  }
  // If the number of rungs is odd, the middle rung is cut as well.
  t.bisection_width = rungs % 2 ? 3 : 2;
  if (rungs == 1) t.bisection_width = 1;
  return t;
}

int main(int argc, char** argv) {
  for (const int rungs : {1, 2, 3, argc > 1 ? std::atoi(argv[1]) : 8}) {
    const Topology ladder = make_ladder(rungs);
    check(ladder);  // ports, order of links, connectedness; throws BadInput
    const auto metrics = eval_metrics(ladder);
    fmt::print("{:9}  {:2} links, diameter {}, mean distance {:.3f}\n", ladder.name, metrics.links,
               metrics.diameter, metrics.mean_distance);
    if (metrics.links != 3 * rungs - 2 || metrics.diameter != rungs) return 1;
  }
}

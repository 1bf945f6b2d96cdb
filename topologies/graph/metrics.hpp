#pragma once
// What a wiring promises before anything runs on it: distances, bisection, where traffic piles up.

#include <cstdint>
#include <optional>

#include "topologies/graph/all_pairs.hpp"

namespace topologies {

/// The direction of a link that carries the most messages; of several, the one on the first link
/// and, on that, a to b. Processors are -1 when there is no link.
struct BusiestLink {
  int from = -1, to = -1;
  std::int64_t messages = 0;
};

BusiestLink find_busiest(const Topology& topology, const Load& load);

struct Metrics {
  int processors = 0;
  int links = 0;
  int degree_min = 0, degree_max = 0;  ///< links of a processor
  int diameter = 0;                    ///< links
  double mean_distance = 0;            ///< links, over ordered pairs of distinct processors
  std::optional<int> bisection_width;  ///< fewest links between two halves (sizes differ by <= 1)
  /// Every processor sends the root one message and gets one, by the spanning tree from the root: a
  /// link carries its subtree each way.
  BusiestLink farm;
  BusiestLink all_to_all;  ///< one message per ordered pair, by the routing table
};

/// Measures a topology that passes `check`, in O(processors) memory and the time of eval_all_pairs.
/// The bisection is the generator's, or exact for any wiring without cycles and for up to 32
/// processors, or absent.
Metrics eval_metrics(const Topology& topology);

}  // namespace topologies

#pragma once
// Static metrics of a topology: distances, bisection width, busiest links.

#include <cstdint>
#include <optional>

#include "topologies/graph/all_pairs.hpp"

namespace topologies {

/// The link direction with the most messages. Ties go to the first link, and on it to a to b.
/// Processors are -1 without a link.
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
  /// Load if every processor sends the root one message and gets a reply, along the spanning tree
  /// from the root: a link carries one message per processor of its subtree each way.
  BusiestLink farm;
  BusiestLink all_to_all;  ///< load of one message per ordered pair, by the routing table
};

/// Measures a topology that passes `check`, in O(processors) memory and the time of eval_all_pairs.
/// The bisection width is the generator's. Otherwise it is exact for trees and for up to 32
/// processors, and absent for others.
Metrics eval_metrics(const Topology& topology);

}  // namespace topologies

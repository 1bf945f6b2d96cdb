#pragma once
// Static metrics of a topology: distances, bisection width, busiest links.

#include <cstdint>
#include <optional>

#include "topologies/graph/all_pairs.hpp"

namespace topologies {

/// The direction of a link that carries the most messages. Of several, the one on the first link,
/// and there the one from a to b. Processors are -1 if there are no links.
struct BusiestLink {
  int from = -1, to = -1;
  std::int64_t messages = 0;
};

BusiestLink find_busiest(const Topology& topology, const Load& load);

struct Metrics {
  int processors = 0;
  int links = 0;
  int degree_min = 0, degree_max = 0;  ///< number of links at a processor
  int diameter = 0;                    ///< in links
  double mean_distance = 0;            ///< in links, over ordered pairs of distinct processors
  std::optional<int> bisection_width;  ///< minimum number of links between two halves
  /// Link load of a task farm: every processor sends one message to the root and receives a reply
  /// along the spanning tree. In each direction, a link carries one message per processor in its
  /// subtree.
  BusiestLink farm;
  BusiestLink all_to_all;  ///< one message per ordered pair of processors
};

/// Measures a topology that passes `check`, in O(processors) memory and the time of eval_all_pairs.
/// The bisection width comes from the generator if known. Otherwise it is exact for trees and for
/// up to 32 processors, and absent for larger topologies.
Metrics eval_metrics(const Topology& topology);

}  // namespace topologies

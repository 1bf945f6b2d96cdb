#pragma once
// Static metrics of a topology: distances, bisection width, busiest links.

#include <cstdint>
#include <optional>

#include "topologies/graph/all_pairs.hpp"

namespace topologies {

/// The direction of a link that carries the most messages. If several carry equally many, the first
/// link counts, and on it the direction from a to b. Processors are -1 if there are no links.
struct BusiestLink {
  int from = -1, to = -1;
  std::int64_t messages = 0;
};

BusiestLink find_busiest(const Topology& topology, const Load& load);

struct Metrics {
  int processors = 0;
  int links = 0;
  int degree_min = 0, degree_max = 0;  ///< smallest and largest number of links of a processor
  int diameter = 0;                    ///< largest distance, in links
  double mean_distance = 0;            ///< in links, over ordered pairs of distinct processors
  /// Minimum number of links between two halves; none if unknown.
  std::optional<int> bisection_width;
  /// The busiest link in a task farm, where every processor sends one message to the root and
  /// receives one reply along the spanning tree. In each direction, a link carries one message for
  /// each processor in the subtree below it.
  BusiestLink farm;
  BusiestLink all_to_all;  ///< the busiest link for one message per ordered pair of processors
};

/// Measures a topology that passes `check`. Takes O(processors) memory and the time of
/// eval_all_pairs. The generator of the topology states the bisection width for some shapes.
/// Otherwise the width is exact for trees and for up to 32 processors, and absent for larger
/// topologies.
Metrics eval_metrics(const Topology& topology);

}  // namespace topologies

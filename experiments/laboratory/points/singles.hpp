#pragma once
// What speed-ups of networks with a size of their own are measured against.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// Whether points that lack a single worker may be run for it.
enum class Singles { find, run };

/// Sets PointResult::single_s of each complete point whose network says its size itself and whose
/// program leaves its speed-up empty: the time of one worker of the same machine, at another point
/// of the sweep, or else in a run of its own, which is recorded as points are.
void measure_singles(const PointsPlan& plan, Results& results, Singles singles);

}  // namespace laboratory

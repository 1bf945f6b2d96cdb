#pragma once
// Single-worker reference times, for speed-ups on networks that define their own size.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// Treatment of a missing reference time: search other points only, or also run a single worker.
enum class SingleWorker { find, run };

/// Sets PointResult::single_s of each complete point whose network defines its own size and whose
/// program leaves the speed-up empty. This is the time of one worker of the same machine. It comes
/// from another point of the sweep, or from an additional run, which is recorded like a point.
void measure_single_workers(const PointsPlan& plan, Results& results, SingleWorker single_worker);

}  // namespace laboratory

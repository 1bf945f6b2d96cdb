#pragma once
// Single-worker reference times for speed-ups of networks that define their own size.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// Treatment of a missing single worker: search other points only, or also run one.
enum class SingleWorker { find, run };

/// Sets PointResult::single_s of each complete point whose network defines its own size, if its
/// program leaves the speed-up empty. It is the time of one worker of the same machine, from
/// another point of the sweep or from an additional run, recorded like a point.
void measure_single_workers(const PointsPlan& plan, Results& results, SingleWorker single_worker);

}  // namespace laboratory

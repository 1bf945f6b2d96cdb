#pragma once
// Times of a single worker, for the speed-ups on networks that define their own size.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// What to do if the time of a single worker is missing: only search other points, or also simulate
/// it.
enum class SingleWorker { find, run };

/// Sets PointResult::single_s, the time of one worker of the same machine, of complete points whose
/// network defines its own size and whose program leaves the speed-up empty. The time comes from
/// another point of the sweep, or from an additional simulation, which is recorded like a point.
void measure_single_workers(const PointsPlan& plan, Results& results, SingleWorker single_worker);

}  // namespace laboratory

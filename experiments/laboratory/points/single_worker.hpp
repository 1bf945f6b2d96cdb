#pragma once
// Simulated times of a single worker. They give the speed-ups on networks that define their own
// size.
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

/// Action if the time of a single worker is missing: only look it up (`find`), or also simulate the
/// single worker (`run`).
enum class SingleWorker { find, run };

/// Sets PointResult::single_s, the time of one worker of the same machine. Sets it for complete
/// points whose network defines its own size and whose program leaves the speed-up empty. The time
/// comes from another point of the sweep, or from an additional simulation, which is recorded like
/// a point.
void measure_single_workers(const PointsPlan& plan, Results& results, SingleWorker single_worker);

}  // namespace laboratory

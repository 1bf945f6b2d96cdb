#pragma once
// Marks on an axis of simulated time.
#include <cstdint>

namespace observe {

/// Distance between marks, and the unit of their labels.
struct Ticks {
  std::int64_t step_ns, unit_ns;
  const char* unit;
};

/// Chooses ticks for a length of time, s, with at most `most` steps. The step is 1, 2 or 5 times a
/// power of ten.
Ticks choose_ticks(double length_s, double most = 14);

}  // namespace observe

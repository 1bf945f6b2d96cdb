#pragma once
// Tick marks on an axis of simulated time.
#include <cstdint>

namespace observe {

/// Distance between tick marks in ns. The unit of their labels has a length in ns, and a name.
struct Ticks {
  std::int64_t step_ns, unit_ns;
  const char* unit;
};

/// Chooses tick marks for an axis of `length_s` seconds, with at most `most` intervals. Their
/// distance is 1, 2 or 5 times a power of ten.
Ticks choose_ticks(double length_s, double most = 14);

}  // namespace observe

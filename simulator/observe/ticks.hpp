#pragma once
// Marks on an axis of simulated time.
#include <cstdint>

namespace observe {

/// The distance of marks, and the unit of their numbers.
struct Ticks {
  std::int64_t step_ns, unit_ns;
  const char* unit;
};

/// Ticks for a length of time, s, in which there are at most `most` steps: 1, 2 or 5 times a power
/// of ten.
Ticks choose_ticks(double length_s, double most = 14);

}  // namespace observe

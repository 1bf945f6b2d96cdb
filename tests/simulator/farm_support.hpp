#pragma once
// What the farm's tests share.
#include <random>

#include "simulator/farm/priority.hpp"

namespace farm {

// Limits that let some rays through and not others.
inline Limits random_limits(std::mt19937_64& random) {
  Limits limits;
  limits.min_influence = static_cast<double>(random() % 4) / 4;
  limits.depth_reflected = static_cast<int>(random() % 5);
  limits.depth_transmitted = static_cast<int>(random() % 5);
  limits.min_cell = 1 << random() % 5;
  if (random() % 3 == 0) limits.area = {4, 4, 10, 10};
  return limits;
}

}  // namespace farm

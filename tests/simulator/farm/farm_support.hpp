#pragma once
// Functions that the farm's tests share.
#include <random>
#include <sstream>
#include <string>

#include "simulator/farm/farm.hpp"
#include "tests/simulator/scenes.hpp"
#include "tests/support/isolated.hpp"

namespace farm {

using test::isolated;
using test::make_glass_scene;
using test::run_isolated;

// Limits that admit some rays and exclude others.
inline Limits random_limits(std::mt19937_64& random) {
  Limits limits;
  limits.min_influence = static_cast<double>(random() % 4) / 4;
  limits.depth_reflected = static_cast<int>(random() % 5);
  limits.depth_transmitted = static_cast<int>(random() % 5);
  limits.min_cell = 1 << random() % 5;
  if (random() % 3 == 0) limits.area = {4, 4, 10, 10};
  return limits;
}

inline Params small_params() {
  Params params;
  params.image.width = 24;
  params.image.height = 18;
  params.image.limits.depth = 6;
  return params;
}

}  // namespace farm

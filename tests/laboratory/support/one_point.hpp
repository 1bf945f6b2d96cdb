// Arguments for a run that takes almost no time.
#pragma once

#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace laboratory {

/// Arguments that run the farm of experiments/farm.toml on three workers with 16 x 12 pixels and 20
/// spheres. `more` follows them.
inline std::vector<std::string> one_point(const std::vector<std::string>& more) {
  std::vector<std::string> all{"run",   ::test::in_sources("experiments/farm.toml"),
                               "--set", "image.width=16",
                               "--set", "check=[]",
                               "--set", "image.height=12",
                               "--set", "sweep.objects=[20]",
                               "--set", "sweep.workers=[3]"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace laboratory

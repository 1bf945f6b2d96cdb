#pragma once
// Declaration of the farm as a program for experiments.
#include "simulator/farm/shared_farm.hpp"

namespace farm {

struct ProgramParams {
  Params farm;                       ///< the keys of [image], [farm], [[stage]], [[order]]
  std::optional<SharedParams> data;  ///< set if any key of [data] is present
  ray_tracing::SceneChoice scene;
};

/// Makes the program "farm". With Setup::cycles_per_host_s, costs are timed, even during checks.
programs::Program make_farm();

}  // namespace farm

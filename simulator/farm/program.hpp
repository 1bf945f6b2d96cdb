#pragma once
// The farm as a program of experiments.
#include "simulator/farm/shared_farm.hpp"

namespace farm {

struct ProgramParams {
  Params farm;                       ///< [image], [farm], [[stage]], [[order]]
  std::optional<SharedParams> data;  ///< where any key of [data] is given
  tracing::SceneChoice scene;
};

/// The program "farm". Costs are timed where Setup::cycles_per_host_s is given, also when checked.
programs::Program make_farm();

}  // namespace farm

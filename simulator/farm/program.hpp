#pragma once
// The farm as an experiment program.
#include "simulator/farm/shared_farm.hpp"

namespace farm {

struct ProgramParams {
  Params farm;                       ///< [image], [farm], [[stage]], [[order]]
  std::optional<SharedParams> data;  ///< set if any key of [data] is given
  ray_tracing::SceneChoice scene;
};

/// The program "farm". With Setup::cycles_per_host_s, costs are timed, also during checks.
programs::Program make_farm();

}  // namespace farm

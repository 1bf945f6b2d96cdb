#pragma once
// Declaration of IIRRA as a program for experiments.
#include "simulator/iirra/iirra.hpp"

namespace iirra {

struct ProgramParams {
  Params iirra;                                   ///< [image], [iirra], [[stage]], [[order]]
  std::optional<ray_tracing::SharedParams> data;  ///< set if any key of [data] is present
  ray_tracing::SceneChoice scene;                 ///< the keys of [scene]
};

programs::Program make_iirra();

}  // namespace iirra

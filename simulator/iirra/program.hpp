#pragma once
// IIRRA as an experiment program.
#include "simulator/iirra/iirra.hpp"

namespace iirra {

struct ProgramParams {
  Params iirra;                                   ///< [image], [iirra], [[stage]], [[order]]
  std::optional<ray_tracing::SharedParams> data;  ///< set if any key of [data] is given
  ray_tracing::SceneChoice scene;                 ///< [scene]
};

programs::Program make_iirra();

}  // namespace iirra

#pragma once
// IIRRA as a program of experiments.
#include "simulator/iirra/iirra.hpp"

namespace iirra {

struct ProgramParams {
  Params iirra;                               ///< [image], [iirra], [[stage]], [[order]]
  std::optional<tracing::SharedParams> data;  ///< where any key of [data] is given
  tracing::SceneChoice scene;                 ///< [scene]
};

programs::Program make_iirra();

}  // namespace iirra

#pragma once
// Declares IIRRA as a program that experiments can run.
#include "simulator/iirra/iirra.hpp"
#include "simulator/ray_tracing/program.hpp"

namespace iirra {

using ProgramParams = ray_tracing::ProgramParams<Params>;

programs::Program make_iirra();

}  // namespace iirra

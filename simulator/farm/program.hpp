#pragma once
// Declares the farm as a program that experiments can run.
#include "simulator/farm/shared_farm.hpp"
#include "simulator/ray_tracing/program.hpp"

namespace farm {

using ProgramParams = ray_tracing::ProgramParams<Params>;

/// Makes the program "farm". If Setup::cycles_per_host_s is set, the costs of the program come from
/// host timings. This also holds for an experiment that is only checked, not simulated.
programs::Program make_farm();

}  // namespace farm

#pragma once
// Declaration of the farm as a program for experiments.
#include "simulator/farm/shared_farm.hpp"
#include "simulator/ray_tracing/program.hpp"

namespace farm {

using ProgramParams = ray_tracing::ProgramParams<Params>;

/// Makes the program "farm". With Setup::cycles_per_host_s, costs are timed, even during checks.
programs::Program make_farm();

}  // namespace farm

#pragma once
// The farm as a program of experiments.
#include "simulator/declare/program.hpp"
#include "simulator/farm/shared_farm.hpp"

namespace farm {

struct ProgramParams {
  Params farm;                        ///< [image], [farm], [[stage]], [[order]]
  std::optional<SharedParams> data;   ///< where any key of [data] is given
  base::Source scene{"spheres", ""};  ///< "spheres" stands for those of `objects`
  std::int64_t objects = 200;         ///< spheres of a generated scene
};

/// The program "farm". Costs are timed where Setup::cycles_per_host_s is given, also when checked.
programs::Program make_farm();

/// What renderer::load_scene takes: "spheres" and 200 objects are spheres:200.
std::string scene_source(const ProgramParams& params);

}  // namespace farm

// Functions shared by the tests of IIRRA.
#pragma once

#include <fmt/format.h>

#include <random>
#include <string>

#include "renderer/scene/generators.hpp"
#include "simulator/iirra/iirra.hpp"
#include "tests/simulator/scenes.hpp"
#include "tests/support/isolated.hpp"
#include "topologies/make/generators.hpp"

namespace iirra {

using test::isolated;
using test::make_glass_scene;
using test::run_isolated;

inline Params small_params() {
  Params params;
  params.image.width = 24;
  params.image.height = 18;
  params.image.limits.depth = 6;
  params.max_cell = 8;
  return params;
}

inline Setup make_setup(const topologies::Topology& topology) {
  static const auto model = machine::load_model("t805-25");
  return {.model = model, .topology = topology, .routes = topologies::make_routes(topology)};
}

inline Result run(const Params& params, const topologies::Topology& topology,
                  const renderer::Scene& scene) {
  return run_iirra(make_setup(topology), scene, params);
}
inline Result run(const Params& params, const std::string& topology = "mesh:3x3") {
  return run(params, topologies::make_topology(topology), make_glass_scene());
}

}  // namespace iirra

// What the tests of IIRRA share.
#pragma once

#include <fmt/format.h>

#include <random>
#include <string>

#include "renderer/files/nff.hpp"
#include "renderer/scene/generators.hpp"
#include "simulator/iirra/iirra.hpp"
#include "tests/support/isolated.hpp"
#include "topologies/make/generators.hpp"

namespace iirra {

using test::isolated;
using test::run_isolated;

// Glass, a mirror, a floor and two lights: every kind of ray.
inline renderer::Scene make_glass_scene() {
  const std::string text =
      "v\nfrom 0 -4 1.5\nat 0 0 0.3\nup 0 0 1\nangle 40\nhither 0.01\nresolution 24 24\n"
      "b 0.2 0.4 0.7\nl 3 -4 5\nl -4 -2 3 0.5 0.4 0.3\n"
      "f 0.8 0.7 0.5 0.9 0 1 0 1\np 4\n-5 -5 -1\n5 -5 -1\n5 5 -1\n-5 5 -1\n"
      "f 0.9 0.9 1 0.1 0.3 20 0.6 1.5\ns -0.5 0 0.1 0.8\n"
      "f 1 0.5 0.3 0.4 0.5 8 0 1\ns 0.8 0.6 0 0.7\nc\n0.2 -1 -1 0.4\n0.2 -1 0 0.1\n";
  return renderer::parse_nff(text, "glass");
}

inline Params small_params() {
  Params params;
  params.image.width = 24;
  params.image.height = 18;
  params.image.limits.depth = 6;
  params.max_cell = 8;
  return params;
}

inline Result run(const Params& params, const topologies::Topology& topology,
                  const renderer::Scene& scene) {
  return run_iirra(machine::load_model("t805-25"), topology, topologies::make_routes(topology),
                   std::nullopt, scene, params);
}
inline Result run(const Params& params, const std::string& topology = "mesh:3x3") {
  return run(params, topologies::make_topology(topology), make_glass_scene());
}

}  // namespace iirra

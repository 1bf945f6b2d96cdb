#pragma once
// File with the state of an interrupted rendering, which another run can continue.

#include <string>
#include <utility>
#include <vector>

#include "renderer/progressive/refinement.hpp"

namespace laboratory {

/// The inputs of a rendering, as names and values. A rendering can continue a state only if all of
/// them are equal.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// Collects the program's version, the scene, the pixel order and all parameters. A generated scene
/// is identified by its name. A scene file is identified by its bytes and those of the files it
/// names, not by its own name.
Identity identify(const std::string& scene, const renderer::Params& params,
                  renderer::progressive::Order order);

/// Writes the file as base::save_whole does.
void save_state(const std::string& path, const Identity& identity,
                const renderer::progressive::RefinementState& state);

/// Loads a state. Throws BadInput with the path for a file that is not a state, is damaged, or has
/// another identity.
renderer::progressive::RefinementState load_state(const std::string& path,
                                                  const Identity& identity);

}  // namespace laboratory

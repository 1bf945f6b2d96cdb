#pragma once
// The file with the state of a rendering, for continuation by another run.

#include <string>
#include <utility>
#include <vector>

#include "renderer/progressive/refinement.hpp"

namespace laboratory {

/// The inputs of a rendering, as names and values. A rendering can continue a state only if all of
/// them are equal.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// The program's version, the scene, the order and all parameters. A generated scene is identified
/// by its name; a file by its bytes and those of the files it names, not by its name.
Identity identify(const std::string& scene, const renderer::Params& params,
                  renderer::progressive::Order order);

/// Writes the file as base::save_whole does.
void save_state(const std::string& path, const Identity& identity,
                const renderer::progressive::RefinementState& state);

/// Throws BadInput "path: ..." for a file that is not a state, is damaged, or has another identity.
renderer::progressive::RefinementState load_state(const std::string& path,
                                                  const Identity& identity);

}  // namespace laboratory

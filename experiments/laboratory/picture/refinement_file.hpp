#pragma once
// The file that holds the state of a rendering, so that another run goes on with it.

#include <string>
#include <utility>
#include <vector>

#include "renderer/progressive/refinement.hpp"

namespace laboratory {

/// What a state belongs to, as names and values. Only a rendering for which all of them are equal
/// can go on with it.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// The program's version, what the scene is made of, the order and all parameters. A generator is
/// what it is called; of a file its bytes count, not its name, and so do those of the files
/// that it names.
Identity identify(const std::string& scene, const renderer::Params& params,
                  renderer::progressive::Order order);

/// Writes the file as base::save_whole does.
void save_state(const std::string& path, const Identity& identity,
                const renderer::progressive::RefinementState& state);

/// BadInput "path: ..." for a file that is no state, is damaged, or belongs to something else.
renderer::progressive::RefinementState load_state(const std::string& path,
                                                  const Identity& identity);

}  // namespace laboratory

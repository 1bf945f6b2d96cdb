#pragma once
// File with the state of an unfinished rendering, which a later run can continue.

#include <string>
#include <utility>
#include <vector>

#include "renderer/progressive/refinement.hpp"

namespace laboratory {

/// The inputs of a rendering, as names and values. A rendering can continue a state only if all its
/// inputs are equal to those of the state.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// Collects the program's version, the scene, the order of pixels and all parameters. Identifies a
/// generated scene by its name. Identifies a scene file not by its path but by its bytes and the
/// bytes of the files that it refers to.
Identity identify(const std::string& scene, const renderer::Params& params,
                  renderer::progressive::Order order);

/// Writes the state to a file. A failure leaves the previous content of the file
/// (base::save_whole()).
void save_state(const std::string& path, const Identity& identity,
                const renderer::progressive::RefinementState& state);

/// Loads a state of at most `pixels` pixels. Throws BadInput with the path if the file is not a
/// state, is damaged, has a different identity, or is too long for so many pixels.
renderer::progressive::RefinementState load_state(const std::string& path, const Identity& identity,
                                                  std::size_t pixels);

}  // namespace laboratory

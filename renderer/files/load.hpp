#pragma once
// Scenes by name.

#include <string_view>

#include "renderer/scene/scene.hpp"

namespace renderer {

/// "spheres:800" or the path of an .nff file. BadInput for anything else, naming what is valid.
Scene load_scene(std::string_view source);

}  // namespace renderer

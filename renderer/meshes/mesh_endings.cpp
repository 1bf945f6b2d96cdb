#include <array>

#include "renderer/meshes/read_mesh.hpp"

namespace renderer {

std::span<const std::string_view> mesh_endings() {
  static constexpr std::array<std::string_view, 7> ENDINGS = {".stl", ".ply",  ".off", ".dae",
                                                              ".3ds", ".gltf", ".glb"};
  return ENDINGS;
}

}  // namespace renderer

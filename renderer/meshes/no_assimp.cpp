// Replaces read_mesh() in builds without Assimp.
#include "base/errors.hpp"
#include "renderer/meshes/read_mesh.hpp"

namespace renderer {

void read_mesh(const std::string& path, ObjTarget& /*target*/, LeftOut& /*left_out*/) {
  throw base::BadInput(path +
                       ": found a mesh file, but this tlab was built without Assimp; install "
                       "Debian's libassimp-dev and rebuild");
}

}  // namespace renderer

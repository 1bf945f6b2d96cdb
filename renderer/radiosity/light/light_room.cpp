#include "renderer/radiosity/light/light_room.hpp"

#include <set>

namespace radiosity {

LitRoom light_room(const Room& room, const LightParams& params) {
  LitRoom lit{make_mesh(room, params.mesh), {}};
  Solution solution;
  if (params.senders > 0) {
    MeshParams coarse = params.mesh;
    coarse.refine = params.senders;
    solution = relight(make_mesh(room, coarse), lit.mesh, params.solve);
  } else {
    solution = solve(lit.mesh, params.solve);
  }
  lit.vertices = std::move(solution.vertices);
  if (params.ambient) add_ambient(lit.mesh, solution.ambient, lit.vertices);
  return lit;
}

double eval_mean_radiosity(const LitRoom& lit, const Mesh& other) {
  std::set<std::string> shared;
  for (const Patch& patch : other.patches) shared.insert(other.materials[patch.material].name);
  double sum = 0, area = 0;
  for (const Patch& patch : lit.mesh.patches) {
    if (!shared.contains(lit.mesh.materials[patch.material].name)) continue;
    area += patch.area;
    for (const auto corner : patch.corners) {
      const Rgb& b = lit.vertices[corner];
      sum += patch.area * (b.r + b.g + b.b) / 12;
    }
  }
  return sum / area;
}

}  // namespace radiosity

#pragma once
// A room's mesh and illumination, in one step.

#include "renderer/radiosity/light/solve.hpp"

namespace radiosity {

/// The mesh of a room and its illumination.
struct LitRoom {
  Mesh mesh;
  std::vector<Rgb> vertices;  ///< radiosity, by vertex of the mesh
};

struct LightParams {
  MeshParams mesh;
  int senders = 0;  ///< MeshParams::refine of a second mesh whose patches send the light, see
                    ///< relight(), 1 to 1000; 0: those of the mesh itself do
  SolveParams solve;
  bool ambient = true;  ///< whether eval_ambient(), an estimate of the unsent light, is added
};

/// The room must pass check(). BadInput as make_mesh and solve.
LitRoom light_room(const Room& room, const LightParams& params);

/// The mean radiosity of the mesh's patches by area, over the three colours; only patches of
/// materials count that patches of `other` have too.
double eval_mean_radiosity(const LitRoom& lit, const Mesh& other);

}  // namespace radiosity

#pragma once
// Borders of surfaces in a mesh. Vertices are doubled at creases, so that the light may differ on
// both sides. The light of a vertex on a border is computed slightly inside the surface.

#include <vector>

#include "renderer/radiosity/mesh/contacts.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Creases separate the patches around a vertex into groups. Gives each group its own copy of the
/// vertex, at the same position.
void split_at_creases(Mesh& mesh, const Edges& creases);

/// Lines near a face's border. They determine the distance from the border at which the light of
/// the border's vertices is computed.
struct Fringe {
  std::vector<Crease> creases;  ///< creases and contacts of the face
  const Contacts& contacts;
  double width;  ///< width of the face's patches
};

/// Splits the mesh at the edges that lie on creases and on contacts, where another object touches
/// the face. Contacts become borders of the surface. Sets Vertex::lit of the vertices on borders as
/// MeshParams::inset describes. `fringes` has one entry per face.
void split_and_inset(Mesh& mesh, const Edges& creases, const Edges& contacts, double inset,
                     std::span<const Fringe> fringes);

}  // namespace radiosity

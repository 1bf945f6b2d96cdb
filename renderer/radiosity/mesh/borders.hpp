#pragma once
// Borders of surfaces in a mesh: vertices are doubled at creases, and the light of vertices on a
// border is computed slightly inside.

#include <vector>

#include "renderer/radiosity/mesh/contacts.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Gives each group of patches around a vertex its own copy of the vertex, at the same position.
/// Creases separate groups.
void split_at_creases(Mesh& mesh, const Edges& creases);

/// Lines near a face's border. They determine at what distance from the border the light of its
/// vertices is computed.
struct Fringe {
  std::vector<Crease> creases;  ///< creases and contacts of the face
  const Contacts& contacts;
  double width;  ///< width of a patch
};

/// Splits the mesh at the edges on creases, some of which lie on contacts, and sets Vertex::lit of
/// the vertices on borders, as MeshParams::inset describes. Contacts become borders. `fringes` has
/// one entry per face.
void split_and_inset(Mesh& mesh, const Edges& creases, const Edges& contacts, double inset,
                     std::span<const Fringe> fringes);

}  // namespace radiosity

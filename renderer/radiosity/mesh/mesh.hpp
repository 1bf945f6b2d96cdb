#pragma once
// The mesh of a room, which consists of patches. Neighbouring patches share vertices where the
// illumination is smooth. Vertices are doubled where reflectance, emission or normal differ, and at
// creases (thesis, 3.1.4.2).

#include <array>
#include <limits>
#include <set>
#include <span>

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

struct Vertex {
  Vec at;
  /// The point at which the vertex's illumination is computed, usually `at`. For vertices on
  /// borders and contacts, the point is slightly inside the face. From there, the adjacent faces
  /// are visible, and the point is outside shadows along the border that are too narrow for
  /// patches.
  Vec lit;
  Vec normal;  ///< unit normal of the surface
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< object in Mesh::blockers on which the vertex lies
};

/// A convex quad. Its corners are counter-clockwise as seen from its front, and have the parameters
/// (s, t) = (0,0), (1,0), (1,1), (0,1).
struct Patch {
  /// Vertices at the corners, as indices into Mesh::vertices.
  std::array<std::uint32_t, 4> corners{};
  std::array<Vec, 4> at;  ///< positions of the corners
  Vec centre;
  Vec normal;  ///< unit normal of the front
  double area = 0;
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< the face's object in Mesh::blockers
  std::uint32_t face = 0;    ///< index of the face in Room::faces
};

/// A flat mirror. It is not divided into patches. It reflects at its front; its back is black.
struct Mirror {
  std::vector<Vec> corners;  ///< counter-clockwise as seen from the front
  Vec normal;                ///< unit normal of the front
  Vec centre;                ///< mean of the corners
  double width = 0;          ///< area divided by the longest edge
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< the mirror's object in Mesh::blockers
};

struct Mesh {
  std::vector<Material> materials;
  std::vector<Vertex> vertices;
  std::vector<Patch> patches;
  std::vector<Mirror> mirrors;
  /// The scene for visibility rays; contains every face once.
  renderer::Scene blockers;
  double area = 0;  ///< total area of the patches, in squares of the room's unit
  Rgb emitted;      ///< total power that the patches emit, by colour
  Rgb reflectance;  ///< mean reflectance of the patches, weighted by area
  /// Largest illumination from one delta area (a part of a patch), as the mean of the colours. A
  /// visible delta area that would give more is halved. Infinite unless Room::fine_shadows.
  double most_at_once = std::numeric_limits<double>::infinity();
  /// Number of creases that did not completely become edges of patches, counted for each side of a
  /// face.
  std::size_t left_out = 0;
};

struct MeshParams {
  int refine = 1;  ///< factor by which the divisions of every face are multiplied, 1 to 1000
  /// Limit on the number of patches with creases, 1 to 1000, as a multiple of the number without
  /// creases (after halving near lights). At least 2000 patches are always allowed. If the limit is
  /// exceeded, strips below hanging faces are removed until there are at most half as many patches
  /// as allowed. Then creases are omitted: the last creases of each face, in the faces that grow
  /// most.
  int crease_growth = 4;
  /// The point at which the light of a border vertex is computed, 0 to 0.5. It is the fraction of
  /// the way from the vertex to the mean of its patches' centres. If this mean lies outside the
  /// patches, the centre of the largest patch replaces it. The fraction is larger, up to a half, if
  /// the way crosses a crease that is too near to become an edge. Behind a gap along the border,
  /// such as under a hanging face or over a narrow ledge, the fraction is chosen so that the mean
  /// over the patch is right. With 0, the light is computed at the border itself.
  double inset = 0.01;
};

/// Makes the fields refine and crease_growth.
base::Fields<MeshParams> mesh_fields();

/// Makes the mesh of a room, which must pass check(). Contacts of faces (find_contacts) become
/// creases: the illumination on their two sides is separate. At the foot of an upright edge, where
/// a contact turns, each sector between two creases has its own illumination. With
/// Room::fine_near_lights, the patches are those of make_graded(). Throws BadInput for more than 10
/// million patches.
Mesh make_mesh(const Room& room, const MeshParams& params);

/// The patches around every vertex. Those of vertex v are patches[first[v]] up to patches[first[v +
/// 1] - 1].
struct Surroundings {
  std::vector<std::uint32_t> first, patches;
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(patches).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};
Surroundings find_surroundings(const Mesh& mesh);

/// Edges between two vertices; in each pair, the lower index is first.
using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

}  // namespace radiosity

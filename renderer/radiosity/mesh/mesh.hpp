#pragma once
// A room's mesh of patches. Neighbours share vertices where the illumination is smooth. Vertices
// are doubled where reflectance, emission or normal differ, and at creases (3.1.4.2).

#include <array>
#include <limits>
#include <set>
#include <span>

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

struct Vertex {
  Vec at;
  /// Point at which the illumination of the vertex is computed, usually `at`. At borders and
  /// contacts, the point lies slightly inside the face: there the adjacent faces are visible from
  /// it, and it is outside of shadows along the border that are too narrow for patches.
  Vec lit;
  Vec normal;  ///< unit normal of the surface
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< object of Mesh::blockers on which the vertex lies
};

/// A convex quad. Its corners run counter-clockwise as seen from its front, and have the parameters
/// (s, t) = (0,0), (1,0), (1,1), (0,1).
struct Patch {
  std::array<std::uint32_t, 4> corners{};  ///< corner vertices, as indices into Mesh::vertices
  std::array<Vec, 4> at;                   ///< positions of the corners
  Vec centre;
  Vec normal;  ///< unit normal of the front
  double area = 0;
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< object of the patch in Mesh::blockers
  std::uint32_t face = 0;    ///< face of the patch in Room::faces
};

/// A flat mirror, undivided. It reflects at its front and is black at its back.
struct Mirror {
  std::vector<Vec> corners;  ///< corners, counter-clockwise
  Vec normal;                ///< unit normal of the front
  Vec centre;                ///< mean of the corners
  double width = 0;          ///< width: area over longest edge
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< object of the mirror in Mesh::blockers
};

struct Mesh {
  std::vector<Material> materials;
  std::vector<Vertex> vertices;
  std::vector<Patch> patches;
  std::vector<Mirror> mirrors;
  /// scene against which visibility rays are cast; contains every face once
  renderer::Scene blockers;
  double area = 0;  ///< area of all patches, in squares of the room's unit
  Rgb emitted;      ///< power that all patches emit
  Rgb reflectance;  ///< mean reflectance of the patches, weighted by area
  /// Largest illumination from one delta area, as the mean of the colours. A visible delta area
  /// that would give more is halved. Infinite unless Room::fine_shadows.
  double most_at_once = std::numeric_limits<double>::infinity();
  /// Number of creases that are not completely edges of patches, counted for each side of a face.
  std::size_t left_out = 0;
};

struct MeshParams {
  int refine = 1;  ///< factor on the divisions of every face, 1 to 1000
  /// Limit on the number of patches with creases, 1 to 1000, as a multiple of the number without
  /// creases (after halving near lights). At least 2000 patches are always allowed. If the limit is
  /// exceeded, strips below hanging faces are removed until they fit half of it. Then creases are
  /// left out: the last ones of each face first, in the faces that grow most.
  int crease_growth = 4;
  /// Distance from the border at which the light of a border vertex is computed, 0 to 0.5, as a
  /// share of the way to the mean centre of its patches. If this centre lies outside of them, it is
  /// replaced by the largest patch's centre. The distance is larger, up to half the way, if the way
  /// crosses a crease that is too near to be kept. Behind a gap along the border, such as under a
  /// hanging face or over a narrow ledge, the distance is chosen so that the mean over the patch is
  /// right. With 0, light is computed at the border itself.
  double inset = 0.01;
};

/// Makes the fields refine and crease_growth.
base::Fields<MeshParams> mesh_fields();

/// Builds the mesh of a room, which must pass check(). Contacts of faces (find_contacts) become
/// creases, with separate illumination on their two sides. At the foot of an upright edge, where a
/// contact turns, each sector between two creases has an illumination of its own. With
/// Room::fine_near_lights, the patches are those of make_graded(). Throws BadInput beyond 10
/// million patches.
Mesh make_mesh(const Room& room, const MeshParams& params);

/// The patches around all vertices, vertex by vertex. Those of vertex v are in `patches` from
/// `first[v]` up to `first[v + 1]`, exclusive.
struct Surroundings {
  std::vector<std::uint32_t> first, patches;
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(patches).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};
Surroundings find_surroundings(const Mesh& mesh);

/// Edges between two vertices, the lower index first.
using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

}  // namespace radiosity

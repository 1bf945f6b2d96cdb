#pragma once
// A room cut into patches. Neighbours share vertices where the illumination is smooth; where it is
// not (another reflectance, emission or normal, a crease) vertices are doubled (3.1.4.2).

#include <array>
#include <limits>
#include <set>
#include <span>

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

struct Vertex {
  Vec at;
  Vec lit;     ///< point at which its illumination is found: `at`, but at the border of a surface
               ///< or on a contact a little inside, where what touches it there is seen, and not
               ///< in a shadow along the border that is too narrow for patches to show
  Vec normal;  ///< unit
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< index of the object of Mesh::blockers that it lies on
};

/// A convex quad. Its corners run counter-clockwise as seen from its front and have the parameters
/// (s, t) = (0,0), (1,0), (1,1), (0,1).
struct Patch {
  std::array<std::uint32_t, 4> corners{};  ///< indices into Mesh::vertices
  std::array<Vec, 4> at;                   ///< where the corners are
  Vec centre;
  Vec normal;  ///< unit
  double area = 0;
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< index into Mesh::blockers
  std::uint32_t face = 0;    ///< index into Room::faces
};

/// A flat mirror, whole; it reflects at its front and is black at its back.
struct Mirror {
  std::vector<Vec> corners;  ///< counter-clockwise
  Vec normal;                ///< unit
  Vec centre;                ///< mean of the corners
  double width = 0;          ///< its area over its longest edge
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< index into Mesh::blockers
};

struct Mesh {
  std::vector<Material> materials;
  std::vector<Vertex> vertices;
  std::vector<Patch> patches;
  std::vector<Mirror> mirrors;
  renderer::Scene blockers;  ///< what rays are cast against: every face once
  double area = 0;           ///< of all patches, in squares of the room's unit
  Rgb emitted;               ///< power that all patches emit
  Rgb reflectance;           ///< mean reflectance of the patches, by area
  /// Illumination, mean of the colours: a delta area that would give more, if it is seen, is
  /// halved. Infinite unless Room::fine_shadows.
  double most_at_once = std::numeric_limits<double>::infinity();
  std::size_t left_out = 0;  ///< creases that the patches do not keep, or not everywhere: once for
                             ///< each side of a face
};

struct MeshParams {
  int refine = 1;  ///< factor of the divisions of every face, 1 to 1000
  /// Limit of the patches with creases, as a multiple of those without (after halving near lights),
  /// 1 to 1000; at least 2000 patches. Above the limit strips below hanging faces are coarsened, to
  /// half of the limit at most, and creases are left out: first on the faces that grow most, and on
  /// each the last one first.
  int crease_growth = 4;
  /// Distance inside the border at which border vertices are lit, a share of the way to the mean
  /// centre of their patches (or, if that is outside of them, to the centre of the largest), 0 to
  /// 0.5. Larger, up to half the way, beyond creases too near to be kept. Behind a gap along the
  /// border, such as under a hanging face or over a narrow ledge, it is the distance that makes the
  /// patch's mean right. 0: none of this.
  double inset = 0.01;
};

/// The fields refine and crease_growth.
base::Fields<MeshParams> mesh_fields();

/// Builds the mesh of a room, which must pass check(). Contacts of faces (find_contacts) are
/// creases, with separate illumination on their two sides. At the foot of an edge, where a contact
/// turns, the illumination is separate between any two creases. If Room::fine_near_lights, the
/// patches are those of make_graded(). BadInput beyond 10 million patches.
Mesh make_mesh(const Room& room, const MeshParams& params);

/// The patches around every vertex, in order: those of vertex v are `patches` from first[v] to
/// first[v + 1].
struct Surroundings {
  std::vector<std::uint32_t> first, patches;
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(patches).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};
Surroundings find_surroundings(const Mesh& mesh);

/// Edges between vertices, the lower index first.
using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Gives every group of patches that creases divide around a vertex a vertex of its own; copies
/// have the same place.
void split_at_creases(Mesh& mesh, const Edges& creases);

}  // namespace radiosity

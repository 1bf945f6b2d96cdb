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
  int refine = 1;         ///< factor of the divisions of every face, 1 to 1000
  int crease_growth = 4;  ///< times as many patches as without creases (after halving near lights)
                          ///< that the room may have with them, or 2000 patches if that is more, 1
                          ///< to 1000; beyond, strips below what hangs are fewer, until they leave
                          ///< half of it, and creases of the faces that grow most are left out, on
                          ///< each the last first
  double inset = 0.01;    ///< distance inside the border at which its vertices are lit, a share of
                          ///< the way to the mean centre of their patches, 0..0.5; if that is not
                          ///< on them, to the centre of the largest. Further, to half the way,
                          ///< beyond creases that are too near to be kept; and where light falls in
                          ///< by a gap along the border, under what hangs over it or over a narrow
                          ///< ledge, as far as makes the mean of the patch right; 0: none of this
};

/// The fields refine and crease_growth.
base::Fields<MeshParams> mesh_fields();

/// The room must pass check(). Where faces touch each other (find_contacts) is a crease by itself,
/// and the illumination on its two sides is found apart; where it turns, at the foot of an edge,
/// between any two creases that go out from there. If Room::fine_near_lights, the room's patches
/// are those of make_graded(). BadInput beyond 10 million patches.
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

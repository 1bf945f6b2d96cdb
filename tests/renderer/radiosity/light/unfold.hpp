#pragma once
// Rooms with mirrors, and unfolded rooms without mirrors. An unfolded room has mirror images of all
// faces, at the places where the mirrors show them.

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {

/// The plane of a mirror, through the point `at`. Objects in front of it have images behind it.
struct MirrorPlane {
  Vec at, normal;
  Vec reflect(const Vec& p) const { return p - 2 * dot(normal, p - at) * normal; }
};

/// The mirror image of a face. Its corners are in reverse order, because a mirror reverses the
/// sense of rotation.
inline Face reflect(Face face, const MirrorPlane& plane) {
  for (Vec& corner : face.corners) corner = plane.reflect(corner);
  std::reverse(face.corners.begin() + 1, face.corners.end());
  if (face.corners.size() == 4) std::swap(face.along, face.across);
  return face;
}

/// Makes the unfolded room: the faces of the room, then their images for each chain of planes. The
/// last plane of a chain reflects first. The mirrors must be the last faces of the room, and are
/// omitted. The k-th image of face f is at f + k * (number of faces without mirrors).
inline Room unfold(const Room& room, const std::vector<std::vector<MirrorPlane>>& chains) {
  Room unfolded = room;
  std::erase_if(unfolded.faces, [&](const Face& f) { return room.materials[f.material].mirror; });
  const std::vector<Face> faces = unfolded.faces;
  for (const auto& chain : chains)
    for (Face face : faces) {
      for (auto plane = chain.rbegin(); plane != chain.rend(); ++plane)
        face = reflect(face, *plane);
      unfolded.faces.push_back(face);
    }
  return unfolded;
}

/// The form factor of each face of the room at a vertex, directly and via mirrors.
inline std::vector<double> eval_by_mirrors(const Eye& eye, const Vertex& vertex,
                                           std::size_t faces) {
  std::vector<double> shares(faces);
  Work work;
  for (const Patch& patch : eye.mesh.patches)
    shares[patch.face] += eval_factors(eye, vertex, patch, work).r;
  return shares;
}
/// The form factor of each face together with its images in the unfolded room.
inline std::vector<double> eval_by_images(const Eye& eye, const Vertex& vertex, std::size_t faces) {
  std::vector<double> shares(faces);
  Work work;
  for (const Patch& patch : eye.mesh.patches)
    shares[patch.face % faces] += eval_factor(eye, vertex, patch, work);
  return shares;
}

/// Adds walls of the cube from 0 to 2, with n x n patches each. `walls` names them by letters of
/// "xXyYzZ": low x, high x, low y and so on.
inline void add_walls(Room& room, const std::string& walls, int n, std::uint32_t material = 0) {
  constexpr Vec O{0, 0, 0}, X{2, 0, 0}, Y{0, 2, 0}, Z{0, 0, 2};
  constexpr struct {
    char name;
    Vec corner, along, across;
  } WALLS[] = {{'x', O, Y, Z}, {'X', X, Z, Y}, {'y', O, Z, X},
               {'Y', Y, X, Z}, {'z', O, X, Y}, {'Z', Z, Y, X}};
  for (const char name : walls)
    for (const auto& wall : WALLS)
      if (wall.name == name) add_quad(room, material, wall.corner, wall.along, wall.across, n, n);
}

/// A cube of white walls with a lamp and a perfect mirror. With `things`, also a table and a screen
/// that cast shadows.
inline Room make_cube(const std::string& walls, bool things, int n) {
  Room room;
  room.materials = {
      {"wall", {0.6, 0.5, 0.4}, {}}, {"lamp", grey(0), grey(5)}, {"mirror", grey(1), {}, true}};
  add_walls(room, walls, n);
  room.faces[0].material = 1;
  if (things) {
    add_block(room, 0, {1.2, 0.4, 0.1}, {1.7, 0.8, 0.5}, 1);
    add_quad(room, 0, {0.7, 1.1, 0.6}, {0.5, 0.3, 0.2}, {-0.1, 0.1, 0.8}).two_sided = true;
  }
  return room;
}

inline constexpr MirrorPlane HIGH_X{{2, 0, 0}, {-1, 0, 0}}, HIGH_Y{{0, 2, 0}, {0, -1, 0}},
    LOW_X{{0, 0, 0}, {1, 0, 0}};

}  // namespace radiosity::test

#pragma once
// Faces with data for the search of contacts, and pairs of such faces.

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

inline constexpr double OFF_PLANE = 1e-6;  ///< tolerance as a fraction of the face's size

struct Flat {
  const Face* face;
  Plane plane;
  std::vector<Plane> edges;  ///< planes through the edges, with the face above them
  renderer::Bounds bounds;
  double size;         ///< length of the diagonal of `bounds`
  double width;        ///< smallest width of the face
  double patch_width;  ///< width of a patch in an evenly divided face

  /// Largest height above this face at which an edge of another face hangs over it (see
  /// find_contacts).
  double gap() const { return patch_width; }
  double reach() const { return std::max(OFF_PLANE * size, gap()); }
};

Flat make_flat(const Face& face, int refine);

/// Two faces that may touch. Functions describe `other` relative to `on`.
struct Pair {
  const Flat& on;
  const Flat& other;
  double tolerance;
};

Pair make_pair(const Flat& on, const Flat& other);

bool are_coplanar(const Pair& pair);

/// True if two faces in one plane have an area in common.
bool overlap(const Pair& pair);

/// For two faces in one plane: true if part of the border of `on` lies on `other`, or on the border
/// of `other`.
bool share_border(const Pair& pair);

/// The part of a segment that is at least `margin` inside the edges of a face. None if it is not
/// longer than the tolerance.
std::optional<Crease> clip_to(const Flat& flat, const Crease& segment, double margin,
                              double tolerance);

}  // namespace radiosity

#pragma once
// Faces prepared for the search of contacts, and pairs of them.

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

inline constexpr double OFF_PLANE = 1e-6;  ///< tolerance relative to the size of the face

struct Flat {
  const Face* face;
  Plane plane;
  std::vector<Plane> edges;  ///< planes of the edges, with the inside above
  renderer::Bounds bounds;
  double size;         ///< length of the diagonal of the bounds
  double width;        ///< least width of the face
  double patch_width;  ///< width of a patch in an even division

  /// Largest height of an edge beside which patches are graded.
  double gap() const { return patch_width; }
  double reach() const { return std::max(OFF_PLANE * size, gap()); }
};

Flat make_flat(const Face& face, int refine);

/// Two faces that may touch, described relative to the first.
struct Pair {
  const Flat& on;
  const Flat& other;
  double tolerance;
};

Pair make_pair(const Flat& on, const Flat& other);

bool are_coplanar(const Pair& pair);

/// True if two faces in the same plane have an area in common.
bool overlap(const Pair& pair);

/// True if the border of the first of two faces in the same plane has a segment in common with the
/// other.
bool share_border(const Pair& pair);

/// The part of a segment that is at least `margin` inside the edges of a face; none if its length
/// is within the tolerance.
std::optional<Crease> clip_to(const Flat& flat, const Crease& segment, double margin,
                              double tolerance);

}  // namespace radiosity

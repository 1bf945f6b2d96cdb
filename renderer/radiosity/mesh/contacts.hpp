#pragma once
// Contacts between faces: lines where an object stands on a floor, leans on a wall or on another
// object, or where faces intersect.

#include <vector>

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// An edge of a face that hangs a little above another face, with light entering under the edge.
struct HangingEdge {
  Crease below;  ///< projection of the edge onto the lower face
  Vec inward;    ///< unit vector in the plane of the lower face, towards the hanging face
  Plane above;   ///< plane of the hanging face
};

/// A ledge: the strip of a surface in front of a face that stands on the surface.
struct Ledge {
  Crease foot;               ///< line where the face meets the surface
  Vec out;                   ///< unit vector in the plane of the strip, away from the standing face
  std::vector<Plane> edges;  ///< planes at the borders of the surface, with the surface above them
};

/// The width of a ledge from a point of its foot outwards; infinite if there is no edge ahead.
double eval_width(const Ledge& ledge, const Vec& at);

/// The contacts of one face with other faces.
struct Contacts {
  /// Lines at which the illumination jumps, or fades within a fraction of a patch.
  std::vector<Crease> lines;
  /// Lines on this face directly below the free edge of a face that hangs above it. The slope of
  /// the illumination changes there.
  std::vector<Crease> folds;
  std::vector<Crease> strips;  ///< lines beside folds; the light fades smoothly between them
  std::vector<HangingEdge> hanging;
  std::vector<Ledge> ledges;  ///< ledges on the surfaces on which the face stands
  Vec lift;                   ///< displacement of the face, see find_lifts()
};

inline constexpr std::size_t MOST_STRIPS = 96;

/// Finds, for each face, the segments where other faces touch its front, within 1e-6 of the larger
/// face's size, or overlap with it in its plane. Overlapping faces that it covers do not count.
/// Two-sided faces can be touched on both sides. If only the borders of two faces touch, as with
/// walls, there is no contact, unless a third face continues the surface of one of them.
///
/// A face hangs over another if it is at most a patch's width above it, roughly parallel to it, and
/// at least as wide as a patch or as 17 times its height. An edge of the hanging face is open if no
/// face descends from it and no face that hangs equally low continues beyond it. An open edge lower
/// than a hundredth of a patch's width counts as touching. A higher one makes a fold below it, and
/// strips on both sides of the fold. The strips end at 0.5, 1, 2, 4, ... times the edge's height
/// from the fold, but at most at 0.6 of a patch's width. All open edges over a face together have
/// at most `most_strips` strips on each side. Without strips, an edge up to half a patch's width
/// high counts as touching.
///
/// A ledge is the part of a face in front of a one-sided face that stands on it, upright or nearly
/// so. The width of a patch follows from Face::along and Face::across, multiplied by `refine`.
/// Throws BadInput if more than 1,000,000 + 100 n pairs of the n faces touch or nearly touch.
std::vector<Contacts> find_contacts(const Room& room, int refine,
                                    std::size_t most_strips = MOST_STRIPS);

}  // namespace radiosity

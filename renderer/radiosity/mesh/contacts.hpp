#pragma once
// Contacts between faces: the lines where objects stand on a floor, lean on a wall or on each
// other, and intersections of faces.

#include <vector>

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// An open edge of a face that hangs a little above another.
struct HangingEdge {
  Crease below;  ///< the edge projected to the lower face
  Vec inward;    ///< unit vector towards the hanging face, in the plane of the lower face
  Plane above;   ///< plane of the hanging face
};

/// The strip of a surface in front of a face that stands on it.
struct Ledge {
  Crease foot;               ///< line where the face meets the surface
  Vec out;                   ///< unit vector in the plane of the strip, away from the face
  std::vector<Plane> edges;  ///< planes at the border of the surface, which is above them
};

/// The width of a ledge outwards from a point of its foot; infinite if no edge lies ahead.
double eval_width(const Ledge& ledge, const Vec& at);

/// Contacts of a face with others.
struct Contacts {
  /// lines at which the illumination jumps, or fades within a part of a patch
  std::vector<Crease> lines;
  /// lines below higher open edges; the slope of the illumination changes there
  std::vector<Crease> folds;
  std::vector<Crease> strips;  ///< lines beside folds, where light fades smoothly
  std::vector<HangingEdge> hanging;
  std::vector<Ledge> ledges;  ///< ledges on the surfaces below the face
  Vec lift;                   ///< displacement of the face, see find_lifts()
};

inline constexpr std::size_t MOST_STRIPS = 96;

/// Finds, for each face, the segments where other faces touch it in front, within 1e-6 of the
/// larger face's size, or overlap it in its plane, unless it covers them. Two-sided faces can be
/// touched on both sides. Two faces whose borders touch, like walls, have no contact there, unless
/// a third face continues the surface of one of them.
///
/// A face hangs over another if it is at most a patch's width above it, about parallel to it, and
/// at least as wide as a patch or as 17 times its height. An edge of it is open if no face descends
/// from the edge, and no face that hangs equally near continues beyond it. An open edge lower than
/// a hundredth of a patch's width counts as touching. A higher one makes a fold below it, and
/// strips on both sides of the fold. Strips end at 0.5, 1, 2, 4, ... times the edge's height from
/// the fold, up to 0.6 of a patch's width. All open edges over a face together have at most
/// `most_strips` strips on each side. If there are no strips, an edge up to half a patch's width
/// high counts as touching.
///
/// A ledge is the part of a face in front of a one-sided face that stands upright on it, or nearly
/// so, along its border. The width of a patch follows from Face::along and Face::across, times
/// `refine`. Throws BadInput if more than 1,000,000 + 100 n pairs of the n faces touch or nearly
/// touch.
std::vector<Contacts> find_contacts(const Room& room, int refine,
                                    std::size_t most_strips = MOST_STRIPS);

}  // namespace radiosity

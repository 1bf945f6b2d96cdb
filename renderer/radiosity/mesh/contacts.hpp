#pragma once
// Contacts between faces: the feet of objects that stand on a floor or lean on a wall or on each
// other, and intersections of faces.

#include <vector>

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// An open edge of a face that hangs a little above another.
struct HangingEdge {
  Crease below;  ///< on the lower face, one of the lines
  Vec inward;    ///< unit, in the face's plane
  Plane above;   ///< the hanging face
};

/// The strip of a surface in front of a face that stands on it.
struct Ledge {
  Crease foot;               ///< on the face's border
  Vec out;                   ///< unit, in the strip's plane, away from the face
  std::vector<Plane> edges;  ///< ends of the surface, which is above them
};

/// Width of a ledge outwards from a point of its foot; infinite if no edge is ahead.
double eval_width(const Ledge& ledge, const Vec& at);

/// Contacts of a face with others.
struct Contacts {
  std::vector<Crease> lines;   ///< light changes abruptly across them, or has just faded
  std::vector<Crease> folds;   ///< below open edges that hang higher: the slope of light changes
  std::vector<Crease> strips;  ///< beside folds, where light fades smoothly
  std::vector<HangingEdge> hanging;
  std::vector<Ledge> ledges;  ///< on the surfaces under its feet
};

inline constexpr std::size_t MOST_STRIPS = 96;

/// For each face the segments where other faces touch it in front of it (or on either side, if it
/// is two-sided), or overlap it in its plane, within 1e-6 of the larger face's size. Faces that
/// touch only with their borders, like walls, have no contact, unless a third face continues the
/// surface there.
///
/// A face hangs over another if it is at most a patch's width above it, about parallel to it and at
/// least as wide as a patch. Its open edges count: no face descends from them, and no face beyond
/// them hangs as near. An open edge nearer than a hundredth of a patch's width touches the face. A
/// higher one makes a fold below it and strips on both sides of the fold. They end at half the
/// edge's height, at once, twice, four times it, and so on up to 0.6 of a patch's width. All open
/// edges over a face share `most_strips` on each side. Without any strips, an edge within half a
/// patch's width touches the face.
///
/// A ledge is the remainder of a face in front of a one-sided one that stands on its front by its
/// border, about upright. The sizes of patches follow from a face's `along` and `across`, times
/// `refine`. BadInput if more than 1,000,000 + 100 n of the pairs of n faces touch or nearly touch.
std::vector<Contacts> find_contacts(const Room& room, int refine,
                                    std::size_t most_strips = MOST_STRIPS);

}  // namespace radiosity

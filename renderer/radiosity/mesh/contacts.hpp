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
  std::vector<Plane> edges;  ///< planes at the ends of the surface, with the surface above
};

/// The width of a ledge outwards from a point of its foot; infinite if no edge lies ahead.
double eval_width(const Ledge& ledge, const Vec& at);

/// Contacts of a face with others.
struct Contacts {
  /// lines at which the illumination is discontinuous, or has just faded
  std::vector<Crease> lines;
  /// lines below open edges that hang higher, at which the slope of the illumination changes
  std::vector<Crease> folds;
  std::vector<Crease> strips;  ///< lines beside folds, where light fades smoothly
  std::vector<HangingEdge> hanging;
  std::vector<Ledge> ledges;  ///< ledges on the surfaces below the face
  Vec lift;                   ///< moves the face in front of those that it covers in its plane
};

inline constexpr std::size_t MOST_STRIPS = 96;

/// Finds, for each face, the segments where other faces touch it in front, within 1e-6 of the
/// larger face's size, or overlap it in its plane. Two-sided faces count on both sides. Faces that
/// touch only with their borders, like walls, have no contact, unless a third face continues the
/// surface there.
///
/// If two faces overlap in a plane and show the same side, one of them covers the other: the one
/// that emits, else the smaller one, else the one listed later. It is lifted by at least 1e-7 of
/// the size of the larger face.
///
/// A face hangs over another if it is at most a patch's width above it, about parallel to it, and
/// at least as wide as a patch or as 17 times its height. Its edges are open if no face descends
/// from them, and no face beyond them hangs as near. An open edge nearer than a hundredth of a
/// patch's width touches the face. A higher one makes a fold below it, and strips on both sides of
/// the fold. Strips end at half the edge's height, at once, twice, four times it, and so on up to
/// 0.6 of a patch's width. All open edges over a face share `most_strips` on each side. If there
/// are no strips, an edge within half a patch's width touches the face.
///
/// A ledge is the remainder of a face in front of a one-sided face that stands on it, about
/// upright, by its border. The width of patches follows from `along` and `across` of a face, times
/// `refine`. Throws BadInput if more than 1,000,000 + 100 n pairs of the n faces touch or nearly
/// touch.
std::vector<Contacts> find_contacts(const Room& room, int refine,
                                    std::size_t most_strips = MOST_STRIPS);

}  // namespace radiosity

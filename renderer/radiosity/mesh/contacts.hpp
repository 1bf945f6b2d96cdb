#pragma once
// Where faces touch each other: the feet of what stands on a floor, leans on a wall or on another
// thing, and where a face passes through another.

#include <vector>

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// An open edge of what hangs a little above a face.
struct HangingEdge {
  Crease below;  ///< on the face, one of the lines
  Vec inward;    ///< unit, in the face's plane
  Plane above;   ///< what hangs
};

/// The strip of a surface before a face that stands on it.
struct Ledge {
  Crease foot;               ///< on the face's border
  Vec out;                   ///< unit, in the strip's plane, away from the face
  std::vector<Plane> edges;  ///< where the surface ends, which is above them
};

/// How far a ledge goes out from a point of its foot; infinitely far where no edge is ahead.
double eval_width(const Ledge& ledge, const Vec& at);

/// Where others touch a face.
struct Contacts {
  std::vector<Crease> lines;   ///< across them light changes abruptly, or it has just faded
  std::vector<Crease> folds;   ///< below open edges that hang higher: light changes its slope there
  std::vector<Crease> strips;  ///< beside folds, where light fades smoothly
  std::vector<HangingEdge> hanging;
  std::vector<Ledge> ledges;  ///< that it stands on
};

inline constexpr std::size_t MOST_STRIPS = 96;

/// For each face the segments along which other faces touch it in front of it (of a two-sided one,
/// on either side), or overlap it in its plane, within 1e-6 of the larger face's size. What a face
/// touches by its border only, as walls do each other, is none, unless the surface goes on there in
/// a third face.
///
/// A face hangs over another if it is at most a patch's width above it, about parallel to it and at
/// least as wide as a patch. Its open edges count: nothing goes down from them, and nothing beyond
/// them hangs as near. An open edge nearer than a hundredth of a patch's width touches the face. A
/// higher one makes a fold below it and strips on both sides of the fold. These end at half the
/// edge's height, at once, twice, four times it, and so on up to 0.6 of a patch's width. All open
/// edges over a face share `most_strips` on each side. Without any strips, an edge within half a
/// patch's width touches the face.
///
/// A ledge is what is left of a face before a one-sided one that stands on its front, about
/// upright, by its border. A face's patches are those that it has by its `along` and `across`,
/// times `refine`. BadInput if more than 1,000,000 + 100 n of the pairs of n faces touch or nearly
/// so.
std::vector<Contacts> find_contacts(const Room& room, int refine,
                                    std::size_t most_strips = MOST_STRIPS);

}  // namespace radiosity

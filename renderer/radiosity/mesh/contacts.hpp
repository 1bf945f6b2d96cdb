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
/// a third face. What hangs over a face within the width of its patches, about parallel to it and
/// itself nowhere narrower than a patch, counts by its open edges: those from which nothing goes
/// down, and beyond which nothing hangs as near. An edge nearer than a hundredth of a patch's width
/// touches the face; below a higher one there is a fold, and on its two sides strips end at half
/// its height, once, twice and so on up to 0.6 of a patch's width: each edge of a face has at most
/// `most_strips`, over the number of these edges, on each side. If that is none, it touches the
/// face within half a patch's width. A ledge is what is left of a face before a one-sided one
/// that stands on its front, about upright, by its border. A face's patches are those that it has
/// by its `along` and `across`, times `refine`. BadInput if more than 1,000,000 + 100 n of the
/// pairs of n faces touch or nearly so.
std::vector<Contacts> find_contacts(const Room& room, int refine,
                                    std::size_t most_strips = MOST_STRIPS);

}  // namespace radiosity

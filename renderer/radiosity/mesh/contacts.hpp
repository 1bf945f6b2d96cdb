#pragma once
// Where faces touch each other: the feet of what stands on a floor, leans on a wall or on another
// thing, and where a face passes through another.

#include <vector>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Where others touch a face.
struct Contacts {
  std::vector<Crease> lines;  ///< light changes abruptly across them
  /// Lines under the edges of what hangs a little above the face: some light falls in through the
  /// gap, and has faded here.
  std::vector<Crease> inside;
};

/// For each face the segments along which other faces touch it in front of it (of a two-sided one,
/// on either side), or overlap it in its plane, within 1e-6 of the larger face's size. What a face
/// touches by its border only, as walls do each other, is none, unless the surface goes on there in
/// a third face. What hangs over a face, nowhere higher than a fifth of the width of its patches
/// and at least as wide as one, touches it below its edges, unless something stands there. Patches
/// are counted as if the faces were divided evenly, `refine` times as finely as they are. BadInput
/// if more than 1,000,000 + 100 n of the pairs of n faces touch or nearly so.
std::vector<Contacts> find_contacts(const Room& room, int refine);

}  // namespace radiosity

#pragma once
// Order of faces that overlap in one plane.

#include "renderer/radiosity/mesh/flats.hpp"

namespace radiosity {

/// True if the other of two faces that overlap in one plane covers the first. Both show the same
/// side, and the other one emits, else is smaller, else is listed later.
bool covers(const Room& room, const Pair& pair);

/// The displacement of each face, so that those that cover others are in front of them. A lifted
/// face is above those that it covers by 1e-7 of the size of the larger face. Faces of the same
/// side that abut get the same displacement, those of one material first, unless one of them is
/// below the other. All levels of a stack together stay within 1e-6 of the size of its largest
/// face, unless each is only twice the epsilon of a ray above the next. A two-sided face is lifted
/// to one side, the front of the faces that it covers. The light of its back is lost where it
/// covers them. `neighbours` has, for each face, the others that may touch it.
std::vector<Vec> find_lifts(const Room& room, std::span<const Flat> flats,
                            std::span<const std::vector<std::uint32_t>> neighbours);

}  // namespace radiosity

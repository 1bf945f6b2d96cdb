#pragma once
// Order in depth of faces that overlap in one plane.

#include "renderer/radiosity/mesh/flats.hpp"

namespace radiosity {

/// True if `other` covers `on`, for two faces that overlap in one plane. Both must show the same
/// side. If only one of the faces emits light, it covers the other. Otherwise, the smaller face
/// covers the larger. If they are equally large, the face listed later covers the other.
bool covers(const Room& room, const Pair& pair);

/// The displacement of each face that puts covering faces in front of covered ones. A face is
/// lifted above those that it covers by 1e-7 of the larger face's size. Abutting faces of one side
/// get the same displacement, unless one of them is below the other; pairs of one material are
/// treated first. A stack has many levels if faces cover each other repeatedly. Its levels are then
/// nearer to each other, so that all stay within 1e-6 of the size of the stack's largest face.
/// However, the distance between levels is at least twice the distance that a ray ignores at its
/// start. A two-sided face is lifted to one side, the front of the faces that it covers; the light
/// of its back is lost where it covers them. `neighbours` lists, for each face, the other faces
/// that may touch it.
std::vector<Vec> find_lifts(const Room& room, std::span<const Flat> flats,
                            std::span<const std::vector<std::uint32_t>> neighbours);

}  // namespace radiosity

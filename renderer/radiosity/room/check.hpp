#pragma once
// Validity checks of a room and its parts. Every function throws BadInput "found ..., expected
// ..."; callers add the place.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Maximum number of patches along an edge of a face, before MeshParams::refine.
inline constexpr int MAX_DIVISIONS = 10000;

/// All parts of a room and check_light(). The error begins with the part: "room.txt:12: ...".
void check(const Room& room);

/// Reflectances 0..1, below 1 for a diffuse material; emission >= 0, none for a mirror.
void check_material(const Material& material);

/// At least three finite corners, in a plane within 1e-6 of the face's size, strictly convex and
/// with an area. One normal for each corner on the front's side, or none. 1 to MAX_DIVISIONS
/// patches each way; one of `materials` materials.
void check_face(const Face& face, std::size_t materials);

/// Finite, distinct ends.
void check_crease(const Crease& crease);
/// True if both ends are in the plane of one of the faces, within 1e-6 of the face's size.
bool lies_on_a_face(const Crease& crease, const Room& room);

/// Finite numbers, 1 to 65536 pixels each way, and the conditions of renderer::make_image_plane();
/// returns the view with its image plane.
renderer::View check_view(const renderer::View& view);

/// The room has a non-mirror face, and one that emits. Its parts must be checked.
void check_light(const Room& room);

}  // namespace radiosity

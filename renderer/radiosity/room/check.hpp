#pragma once
// Validity checks of a room and its parts. Every function throws BadInput "found ..., expected
// ..."; callers add the position.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Limit on the number of patches along an edge of a face, before MeshParams::refine.
inline constexpr int MAX_DIVISIONS = 10000;

/// Checks all parts of a room and its light. The error begins with the part: "room.txt:12: ...".
void check(const Room& room);

/// Requires reflectances 0..1, and below 1 for a diffuse material; emission >= 0, and none for a
/// mirror.
void check_material(const Material& material);

/// Requires three or more finite corners of a strictly convex polygon with an area. They must lie
/// in a plane, within 1e-6 of the face's size. Also requires one normal for each corner, on the
/// side of the front, or no normals; 1 to MAX_DIVISIONS patches each way; and a material index
/// below `materials`.
void check_face(const Face& face, std::size_t materials);

/// Requires finite, distinct ends.
void check_crease(const Crease& crease);
/// True if both ends lie in the plane of the same face, within 1e-6 of its size.
bool lies_on_a_face(const Crease& crease, const Room& room);

/// Requires finite numbers, 1 to 65536 pixels each way, and the conditions of
/// renderer::make_image_plane(). Returns the view with its image plane.
renderer::View check_view(const renderer::View& view);

/// Requires a face that is not a mirror, and a face that emits. The parts of the room must be
/// checked before.
void check_light(const Room& room);

}  // namespace radiosity

#pragma once
// Checks of a room and its parts. Every function throws BadInput "found ..., expected ..."; callers
// add the position.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Largest number of patches along an edge of a face, before multiplication by MeshParams::refine.
inline constexpr int MAX_DIVISIONS = 10000;

/// Checks all parts of a room, and that it has light. Messages begin with the part's position, such
/// as "room.txt:12: ...".
void check(const Room& room);

/// Requires reflectances of 0..1, and below 1 for diffuse materials. Requires an emission of at
/// least 0, and no emission for mirrors.
void check_material(const Material& material);

/// Requires at least three finite corners of a strictly convex polygon that is not degenerate. They
/// must lie in one plane, within 1e-6 of the face's size. A face may have no normals, or else one
/// normal for each corner, which points to the front. Also requires 1 to MAX_DIVISIONS patches each
/// way, and a material index below `materials`.
void check_face(const Face& face, std::size_t materials);

/// Requires that the two ends are finite and distinct.
void check_crease(const Crease& crease);
/// True if both ends lie in the plane of one face, within 1e-6 of the face's size.
bool lies_on_a_face(const Crease& crease, const Room& room);

/// Requires finite numbers, 1 to 65536 pixels each way, and the conditions of
/// renderer::make_image_plane(). Returns the view together with its image plane.
renderer::View check_view(const renderer::View& view);

/// Requires that at least one face is not a mirror, and that at least one face emits light. The
/// parts of the room must have been checked before.
void check_light(const Room& room);

}  // namespace radiosity

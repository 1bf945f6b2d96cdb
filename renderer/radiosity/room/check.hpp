#pragma once
// What must hold of a room and of its parts. Every function throws BadInput "found ..., expected
// ..."; callers add the place.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Most patches along an edge of a face, before MeshParams::refine.
inline constexpr int MAX_DIVISIONS = 10000;

/// All parts of a room and check_light(). The error begins with the part: "room.txt:12: ...".
void check(const Room& room);

/// Reflectances 0..1, of a diffuse material below 1; emission >= 0, of a mirror none.
void check_material(const Material& material);

/// Three corners or more, finite, in a plane within 1e-6 of the face's size, strictly convex and
/// around an area; a normal for each or none, on the side of the front; 1 to MAX_DIVISIONS patches
/// each way; one of `materials` materials.
void check_face(const Face& face, std::size_t materials);

/// Finite ends that are apart.
void check_crease(const Crease& crease);
/// Whether both ends are in the plane of one of the faces, within 1e-6 of the face's size.
bool lies_on_a_face(const Crease& crease, const Room& room);

/// Finite numbers and 1 to 65536 pixels each way, and what renderer::make_image_plane() checks;
/// returns the view with its image plane.
renderer::View check_view(const renderer::View& view);

/// The room has a face that is no mirror, and one that emits. Its parts must be checked.
void check_light(const Room& room);

}  // namespace radiosity

#pragma once
// What must hold of each part of a room. Every function throws BadInput "found ..., expected ...";
// who knows where the part stands says so.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Reflectances 0..1, of a diffuse one below 1; emission >= 0, of a mirror none.
void check_material(const Material& material);

/// Three corners or more, finite, in a plane and strictly convex; a normal for each or none, on the
/// side of the front; 1 to 10000 patches each way; one of `materials` materials.
void check_face(const Face& face, std::size_t materials);

void check_crease(const Crease& crease);
/// Whether both ends are in the plane of one of the faces, within 1e-6 of the face's size.
bool lies_on_a_face(const Crease& crease, const Room& room);

/// As renderer::finish does, with finite numbers and 1 to 65536 pixels each way; returns the view
/// with its image plane.
renderer::View check_view(const renderer::View& view);

/// Of the room as a whole: a face that is no mirror, and one that emits. Its parts must be checked.
/// `name` of the file, or "".
void check_light(const Room& room, const std::string& name);

}  // namespace radiosity

#include "renderer/radiosity/files/write_room.hpp"

#include <fmt/format.h>

#include "renderer/files/write_nff.hpp"

namespace radiosity {

namespace {

using renderer::describe;
using renderer::LeftOut;

// Names of the materials, converted to words without blanks.
std::vector<std::string> name_materials(const Room& room) {
  renderer::WordNames names;
  std::vector<std::string> words;
  for (const Material& m : room.materials) words.push_back(names.make(m.name));
  return words;
}

void leave_out(const Room& room, LeftOut& left_out) {
  for (std::size_t i = 0; i < room.creases.size(); ++i) left_out.add("creases");
  for (const Face& face : room.faces)
    if (face.along > 1 || face.across > 1) left_out.add("divisions of faces");
}

// Calls `take` with a face. If the face has two sides, also calls it with the reversed face.
template <class Take>
void each_side(const Face& face, const Take& take) {
  take(face.corners, face.normals);
  if (!face.two_sided) return;
  std::vector<Vec> corners(face.corners.rbegin(), face.corners.rend());
  std::vector<Vec> normals(face.normals.rbegin(), face.normals.rend());
  for (Vec& normal : normals) normal = -normal;
  take(std::move(corners), std::move(normals));
}

}  // namespace

std::string to_text(const Room& room, LeftOut& left_out) {
  const auto& v = room.view;
  std::string text = fmt::format("view from {} at {} up {} angle {} size {} {}\n", describe(v.from),
                                 describe(v.at), describe(v.up), v.angle, v.width, v.height);
  const auto names = name_materials(room);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Material& m = room.materials[i];
    text += fmt::format("{} {} reflect {}", m.mirror ? "mirror" : "material", names[i],
                        describe(m.reflectance));
    text += m.emission == Rgb{} ? "\n" : fmt::format(" emit {}\n", describe(m.emission));
  }
  for (const Face& face : room.faces) {
    const bool is_quad = face.corners.size() == 4;
    text += fmt::format("{} {}", is_quad ? "quad" : "polygon", names[face.material]);
    for (const Vec& corner : face.corners) text += "  " + describe(corner);
    if (face.along > 1 || face.across > 1) {
      text += fmt::format("  divide {}", face.along);
      if (is_quad) text += fmt::format(" {}", face.across);
    }
    text += face.two_sided ? "  two-sided\n" : "\n";
    if (!face.normals.empty()) left_out.add("normals of curved faces");
  }
  for (const Crease& crease : room.creases)
    text += fmt::format("crease {}  {}\n", describe(crease.a), describe(crease.b));
  return text;
}

void tell(const Room& room, renderer::ObjTarget& target, LeftOut& left_out) {
  leave_out(room, left_out);
  target.set_view(room.view);
  const auto names = name_materials(room);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Material& m = room.materials[i];
    renderer::MtlMaterial material{.name = names[i], .emission = m.emission};
    material.set_diffuse(m.mirror ? Rgb{} : m.reflectance);
    if (m.mirror) material.specular = m.reflectance;
    material.illum = m.mirror ? renderer::ILLUM_REFLECTS : 1;
    target.add_material(material);
  }
  std::optional<std::uint32_t> used;
  for (const Face& face : room.faces) {
    if (used != face.material) target.use_material(face.material);
    used = face.material;
    each_side(face, [&](auto corners, auto normals) {
      target.add_face(std::move(corners), std::move(normals), {});
    });
  }
}

void tell(const Room& room, renderer::NffTarget& target, LeftOut& left_out) {
  leave_out(room, left_out);
  target.set_view(room.view);
  for (const Material& m : room.materials)
    if (m.mirror && m.reflectance != Rgb{1, 1, 1}) left_out.add("colours of mirrors");
  std::optional<std::uint32_t> used;
  for (const Face& face : room.faces) {
    const Material& m = room.materials[face.material];
    if (used != face.material) {
      const double ks = m.mirror ? 1 : 0;
      target.set_surface(
          {.colour = m.mirror ? Rgb{1, 1, 1} : m.reflectance, .kd = 1 - ks, .ks = ks});
      if (m.emission != Rgb{}) target.set_emission(m.emission);
    }
    used = face.material;
    each_side(face, [&](auto corners, auto normals) {
      target.add_polygon(std::move(corners), std::move(normals));
    });
  }
}

}  // namespace radiosity

#include "renderer/files/write_obj.hpp"

#include "renderer/files/write_nff.hpp"
#include "renderer/scene/primitives.hpp"

namespace renderer {

ObjText::ObjText(std::string folder, std::string library)
    : folder_(std::move(folder)), library_name_(std::move(library)) {
  check_word(library_name_);
}

std::string ObjText::text() const {
  return (library_.empty() ? "" : fmt::format("mtllib {}\n", library_name_)) + head_ + body_;
}

void ObjText::add_material(const MtlMaterial& m) {
  library_ += fmt::format("newmtl {}\nKd {}\n", m.name, describe(m.diffuse));
  if (m.kd != 1 || m.diffuse == Rgb{})
    library_ += fmt::format("# surface {} {}\n", describe(m.colour), m.kd);
  library_ += fmt::format("Ks {}\nNs {}\n", describe(m.specular), m.shine);
  if (m.emission != Rgb{}) library_ += fmt::format("Ke {}\n", describe(m.emission));
  if (m.transparency > 0)
    library_ += fmt::format("d {}\nTr {}\n", 1 - m.transparency, m.transparency);
  library_ += fmt::format("Ni {}\nillum {}\n", m.ior, m.illum);
  if (!m.picture.empty()) library_ += fmt::format("map_Kd {}\n", find_from(folder_, m.picture));
  names_.push_back(m.name);
}

void ObjText::use_material(std::size_t material) {
  body_ += fmt::format("usemtl {}\n", names_[material]);
}

std::size_t ObjText::number_of(const std::string& statement,
                               std::map<std::string, std::size_t>& known) {
  const auto [item, is_new] = known.try_emplace(statement, known.size() + 1);
  if (is_new) body_ += statement + "\n";
  return item->second;
}

void ObjText::add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                       std::vector<Corner> coordinates) {
  check_polygon(corners, normals);
  std::string face = "f";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    face += fmt::format(" {}", number_of("v " + describe(corners[i]), points_));
    if (!coordinates.empty()) {
      const auto [u, v] = coordinates[i];
      face += fmt::format("/{}", number_of(fmt::format("vt {} {}", u, v), coordinates_));
    }
    if (!normals.empty())
      face += fmt::format("{}{}", coordinates.empty() ? "//" : "/",
                          number_of("vn " + describe(normals[i]), normals_));
  }
  body_ += face + "\n";
}

void ObjText::set_view(const View& view) { head_ = "# " + describe_view(view) + head_; }

void ObjText::set_background(const Rgb& colour) { head_ += "# b " + describe(colour) + "\n"; }

void ObjText::add_light(const Light& light, const std::optional<Rgb>& colour) {
  head_ += "# " + describe_light(light, colour);
}

}  // namespace renderer

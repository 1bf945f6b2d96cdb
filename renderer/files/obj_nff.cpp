#include "renderer/files/obj_nff.hpp"

#include <algorithm>

namespace renderer {

namespace {

constexpr int ILLUM_DIFFUSE = 1, ILLUM_GLOSSY = 5, ILLUM_REFRACTS = 6;

Surface make_surface(const MtlMaterial& m) {
  const auto& [r, g, b] = m.colour;
  require(std::min({r, g, b}) >= 0 && max_component(m.colour) <= MAX_COLOUR, "Kd",
          fmt::format("{} {} {}", r, g, b), fmt::format("0 to {}", MAX_COLOUR));
  Surface s;
  s.colour = m.colour;
  s.kd = m.kd;
  s.shine = m.shine;
  s.t = m.transparency;
  if (m.illum >= ILLUM_REFLECTS) s.ks = max_component(m.specular);
  require(s.ks >= 0 && s.ks <= 1, "Ks", s.ks, "0 to 1");
  if (m.ior > 0) s.ior = m.ior;
  require(m.ior > 0 || s.t == 0, "Ni", m.ior, "above 0 where light passes");
  return s;
}

}  // namespace

void ObjAsNff::add_material(const MtlMaterial& material) {
  Look look{make_surface(material), material.emission};
  const auto& [r, g, b] = material.specular;
  if (look.surface.ks > 0 && (r != g || g != b)) leave_out("colours of mirrors");
  if (look.surface.ks == 0 && material.specular != Rgb{})
    leave_out("highlights without mirror images");
  if (!material.picture.empty()) {
    target_.add_file(material.picture);
    look.surface.texture = target_.add_texture(material.picture, make_mesh_mapping());
  }
  looks_.push_back(look);
}

void ObjAsNff::use_material(std::size_t material) {
  const Look& look = looks_[material];
  target_.line = line;
  target_.set_surface(look.surface);
  if (look.emission != Rgb{}) target_.set_emission(look.emission);
  has_surface_ = true;
}

void ObjAsNff::add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) {
  target_.line = line;
  if (!std::exchange(has_surface_, true)) target_.set_surface({.colour = {0.8, 0.8, 0.8}});
  bounds_ = join(bounds_, make_bounds(corners));
  target_.set_coordinates(std::move(coordinates));
  target_.add_polygon(std::move(corners), std::move(normals));
}

void ObjAsNff::set_view(const View& view) {
  has_view_ = true;
  target_.line = line;
  target_.set_view(view);
}

void ObjAsNff::set_background(const Rgb& colour) {
  target_.line = line;
  target_.set_background(colour);
}

void ObjAsNff::add_light(const Light& light, const std::optional<Rgb>& colour) {
  has_light_ = true;
  target_.line = line;
  target_.add_light(light, colour);
}

void ObjAsNff::finish() {
  if (has_view_) return;
  require(has_surface_ && !(bounds_ == Bounds{}), "no face", "one or more");
  const View view = look_from_outside(bounds_);
  set_view(view);
  if (!has_light_) target_.add_light({.at = view.from}, {});
}

void NffAsObj::set_surface(const Surface& s) {
  next_.emission = {};
  surface_ = {};
  change_surface(s);
}

void NffAsObj::change_surface(const Surface& s) {
  is_new_ = true;
  next_.set_diffuse(s.colour, s.kd);
  next_.specular = {s.ks, s.ks, s.ks};
  next_.shine = s.shine;
  next_.transparency = s.t;
  next_.ior = s.ior;
  next_.illum = s.t > 0                  ? ILLUM_REFRACTS
                : s.ks == 0              ? ILLUM_DIFFUSE
                : s.ks == 1 && s.kd == 0 ? ILLUM_REFLECTS
                                         : ILLUM_GLOSSY;
  next_.picture = s.texture == NO_TEXTURE ? "" : pictures_[s.texture];
  if (s.gloss > 0 && s.gloss != surface_.gloss) left_out_.add("gloss");
  if (s.translucency > 0 && s.translucency != surface_.translucency) left_out_.add("translucency");
  surface_ = s;
}

std::uint32_t NffAsObj::add_texture(const std::string& file, const Mapping& mapping) {
  const bool is_mesh = mapping.kind == Mapping::Kind::mesh;
  if (!is_mesh) left_out_.add("textures that are no mesh's");
  pictures_.push_back(is_mesh ? file : "");
  return static_cast<std::uint32_t>(pictures_.size() - 1);
}

// Switches to the material of the next faces, and adds it if it is new.
void NffAsObj::use_next() {
  const auto is_next = [&](const MtlMaterial& known) {
    next_.name = known.name;
    return known == next_;
  };
  const auto known = std::ranges::find_if(materials_, is_next);
  const auto index = static_cast<std::size_t>(known - materials_.begin());
  if (known == materials_.end()) {
    next_.name = fmt::format("surface_{}", materials_.size() + 1);
    materials_.push_back(next_);
    target_.add_material(next_);
  }
  target_.use_material(index);
}

void NffAsObj::add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) {
  if (std::exchange(is_new_, false)) use_next();
  target_.add_face(std::move(corners), std::move(normals), std::exchange(coordinates_, {}));
}

}  // namespace renderer

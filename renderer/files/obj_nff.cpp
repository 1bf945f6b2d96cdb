#include "renderer/files/obj_nff.hpp"

#include <algorithm>

#include "renderer/scene/triangulate.hpp"

namespace renderer {

namespace {

constexpr int ILLUM_DIFFUSE = 1, ILLUM_GLOSSY = 5;

Surface make_surface(const MtlMaterial& m) {
  Surface s;
  s.colour = m.colour;
  s.kd = m.kd;
  s.shine = m.shine;
  s.t = m.transparency;
  if (m.illum >= ILLUM_REFLECTS) s.ks = max_component(m.specular);
  s.ior = m.ior;
  return s;
}

}  // namespace

void ObjAsNff::add_material(const MtlMaterial& material) {
  Look look{make_surface(material), material.emission};
  const auto& [r, g, b] = material.specular;
  if (look.surface.ks > 0 && (r != g || g != b)) left_out_.add("colours of mirrors");
  if (look.surface.ks == 0 && material.specular != Rgb{})
    left_out_.add("highlights without mirror reflection");
  if (!material.picture.empty()) try {
      look.surface.texture = target_.add_texture(material.picture, make_mesh_mapping());
      target_.add_file(material.picture);
    } catch (const base::BadInput& bad) {
      left_out_.add("pictures", bad.what());
    }
  looks_.push_back(look);
}

// Selects the surface of the next polygon. Removes the picture if the polygon has no texture
// coordinates.
void ObjAsNff::use_look(bool has_coordinates) {
  auto [surface, emission] = looks_[material_];
  const bool has_picture = surface.texture != NO_TEXTURE;
  if (has_picture && !has_coordinates) {
    left_out_.add("pictures on faces without coordinates");
    surface.texture = NO_TEXTURE;
  }
  const Use use{material_, has_picture && has_coordinates};
  if (used_ == use) return;
  used_ = use;
  target_.set_surface(surface);
  if (emission != Rgb{}) target_.set_emission(emission);
}

void ObjAsNff::add_polygon(ObjFace face) {
  check_polygon(face.corners, face.normals);
  use_look(!face.coordinates.empty());
  bounds_ = join(bounds_, make_bounds(face.corners));
  target_.set_coordinates(std::move(face.coordinates));
  target_.add_polygon(std::move(face.corners), std::move(face.normals));
}

void ObjAsNff::add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                        std::vector<Corner> coordinates) {
  target_.line = line;
  ObjFace face{std::move(corners), std::move(normals), std::move(coordinates)};
  if (is_flat(face.corners)) return add_polygon(std::move(face));
  for (ObjFace& part : cut_into_triangles(face)) add_polygon(std::move(part));
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
  require(!(bounds_ == Bounds{}), "no face", "one or more");
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
  if (!is_mesh) left_out_.add("textures with another mapping than mesh");
  pictures_.push_back(is_mesh ? file : "");
  return static_cast<std::uint32_t>(pictures_.size() - 1);
}

// Selects the material of the next faces in the target, and adds it first if it is new.
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

#include "renderer/files/write_nff.hpp"

#include <cctype>
#include <filesystem>

#include "base/text.hpp"
#include "renderer/scene/primitives.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

std::string describe(const Vec& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }
std::string describe(const Rgb& c) { return fmt::format("{} {} {}", c.r, c.g, c.b); }

std::string describe_view(const View& v) {
  return fmt::format("v from {} at {} up {} angle {} hither {} resolution {} {}\n",
                     describe(v.from), describe(v.at), describe(v.up), v.angle, v.hither, v.width,
                     v.height);
}

std::string describe_light(const Light& light, const std::optional<Rgb>& colour) {
  std::string text = light.shape == LightShape::point ? "l " + describe(light.at)
                     : light.shape == LightShape::sphere
                         ? fmt::format("light sphere {} {}", describe(light.at), light.radius)
                         : fmt::format("light rect {} {} {}", describe(light.at), describe(light.u),
                                       describe(light.v));
  if (colour) text += " " + describe(*colour);
  return text + "\n";
}

void check_word(const std::string& name) {
  require(name.find_first_of(" \t\n\r\f\v#") == name.npos, base::quote(name),
          "a name without blanks and without '#'");
}

std::string WordNames::make(std::string name) {
  for (char& c : name) {
    const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
    const bool is_kept = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-';
    if (is_ascii && !is_kept) c = '_';
  }
  if (name.empty()) name = "material";
  const std::string first = name;
  for (int n = 2; !made_.insert(name).second; ++n) name = fmt::format("{}_{}", first, n);
  return name;
}

std::string find_from(const std::string& folder, const std::string& file) {
  const auto path =
      std::filesystem::proximate(file, folder.empty() ? "." : folder).generic_string();
  check_word(path);
  return path;
}

void NffText::set_view(const View& view) { head_ = describe_view(view) + head_; }

void NffText::set_background(const Rgb& colour) { head_ += "b " + describe(colour) + "\n"; }

void NffText::add_light(const Light& light, const std::optional<Rgb>& colour) {
  head_ += (light.shape == LightShape::point ? "" : "# ") + describe_light(light, colour);
}

void NffText::set_surface(const Surface& s) {
  body_ +=
      fmt::format("f {} {} {} {} {} {}\n", describe(s.colour), s.kd, s.ks, s.shine, s.t, s.ior);
  if (s.texture != NO_TEXTURE) body_ += fmt::format("# texture {} mesh\n", pictures_[s.texture]);
  if (s.gloss > 0) body_ += fmt::format("# gloss {}\n", s.gloss);
  if (s.translucency > 0) body_ += fmt::format("# translucent {}\n", s.translucency);
}

void NffText::set_emission(const Rgb& emission) { body_ += "# emit " + describe(emission) + "\n"; }

std::uint32_t NffText::add_texture(const std::string& file, const Mapping&) {
  pictures_.push_back(find_from(folder_, file));
  require(pictures_.back().find('.') != std::string::npos, base::quote(pictures_.back()),
          "a picture's name with a full stop (otherwise '# texture' is an ordinary comment)");
  return static_cast<std::uint32_t>(pictures_.size() - 1);
}

void NffText::set_coordinates(std::vector<Corner> coordinates) {
  coordinates_ = std::move(coordinates);
}

void NffText::add_sphere(const Vec& centre, double radius) {
  body_ += fmt::format("s {} {}\n", describe(centre), radius);
}

void NffText::add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) {
  check_polygon(corners, normals);
  if (!coordinates_.empty()) {
    body_ += "# uv";
    for (const auto& [u, v] : coordinates_) body_ += fmt::format(" {} {}", u, v);
    body_ += "\n";
  }
  body_ += fmt::format("{} {}\n", normals.empty() ? "p" : "pp", corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    body_ += describe(corners[i]);
    if (!normals.empty()) body_ += " " + describe(normals[i]);
    body_ += "\n";
  }
}

void NffText::add_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius) {
  body_ += fmt::format("c {} {} {} {}\n", describe(base), base_radius, describe(apex), apex_radius);
}

}  // namespace renderer

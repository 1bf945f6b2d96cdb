#include "renderer/files/load_scene.hpp"

#include <fmt/ranges.h>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "renderer/files/obj_nff.hpp"
#include "renderer/files/scene_target.hpp"
#include "renderer/scene/generators.hpp"

namespace renderer {

namespace {

// A target that ignores the content of a scene and collects only the names of other files.
struct FileNames : NffTarget {
  std::vector<std::string> files;

  void add_file(const std::string& path) override { files.push_back(path); }
  void set_view(const View&) override {}
  void add_light(const Light&, const std::optional<Rgb>&) override {}
  void set_surface(const Surface&) override {}
  void add_sphere(const Vec&, double) override {}
  void add_polygon(std::vector<Vec>, std::vector<Vec>) override {}
  void add_cone(const Vec&, double, const Vec&, double) override {}
};

}  // namespace

bool is_scene_file(std::string_view source) {
  const std::string name = base::to_lower(source);
  return name.ends_with(".nff") || name.ends_with(".obj");
}

void read_scene(std::string_view text, const std::string& name, NffTarget& target,
                LeftOut* left_out) {
  if (!base::to_lower(name).ends_with(".obj")) return read_nff(text, name, target);
  LeftOut uncounted;
  LeftOut& losses = left_out ? *left_out : uncounted;
  ObjAsNff obj(target, losses);
  read_obj(text, name, obj, losses);
  at_place(name, [&] { obj.finish(); });
}

Scene parse_scene(std::string_view text, const std::string& name, int frame, LeftOut* left_out) {
  SceneTarget target(name);
  read_scene(text, name, target, left_out);
  return target.make_scene(frame);
}

std::vector<std::string> find_files(const std::string& source) {
  if (!is_scene_file(source)) return {};
  FileNames target;
  read_scene(base::read_text(source), source, target);
  return target.files;
}

Scene load_scene(const std::string& source, int frame, LeftOut* left_out) {
  if (is_scene_file(source)) return parse_scene(base::read_text(source), source, frame, left_out);
  std::vector<std::string> forms;
  for (const auto& [name, number, least, most, make] : GENERATORS) {
    const auto prefix = fmt::format("{}:", name);
    forms.push_back(prefix + std::string(number));
    if (!source.starts_with(prefix)) continue;
    if (const auto n = base::parse_number<int>(source.substr(prefix.size()))) return make(*n);
    throw base::BadInput(fmt::format("found scene {}, expected {} with {} from {} to {}",
                                     base::quote(source), forms.back(), number, least, most));
  }
  throw base::BadInput(
      fmt::format("found scene {}, expected a generator ({}) or a file (.nff, .obj)",
                  base::quote(source), fmt::join(forms, ", ")));
}

void tell(const Scene& scene, NffTarget& target) {
  target.set_view(scene.view);
  target.set_background(scene.background);
  for (const Light& light : scene.lights) target.add_light(light, light.intensity);

  const auto corners_of = [&](const Polygon& p) {
    std::vector<Vec> corners;
    for (std::uint32_t i = p.first; i < p.first + p.count; ++i)
      corners.push_back(eval_corner(p, scene.corners[i]));
    return corners;
  };
  std::optional<std::uint32_t> surface;
  for (const Place place : scene.objects)
    visit(scene, place, [&](const auto& object) {
      if (surface != object.tag.surface) target.set_surface(scene.surfaces[object.tag.surface]);
      surface = object.tag.surface;
      using Object = std::decay_t<decltype(object)>;
      if constexpr (std::is_same_v<Object, Sphere>) {
        target.add_sphere(object.centre, object.radius);
      } else if constexpr (std::is_same_v<Object, Cone>) {
        target.add_cone(object.base, object.base_radius, object.base + object.height * object.axis,
                        object.base_radius + object.slope * object.height);
      } else if constexpr (std::is_same_v<Object, Patch>) {
        const auto* first = scene.normals.data() + object.normals;
        target.add_polygon(corners_of(object), {first, first + object.count});
      } else {
        target.add_polygon(corners_of(object), {});
      }
    });
}

}  // namespace renderer

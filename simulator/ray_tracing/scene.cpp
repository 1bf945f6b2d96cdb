#include "simulator/ray_tracing/scene.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "renderer/files/load_scene.hpp"

namespace ray_tracing {

namespace {

// True if the source alone determines the number of objects, so that the key `objects` has no
// effect.
bool has_own_objects(const SceneChoice& scene) { return scene.source.text != "spheres"; }

}  // namespace

base::Fields<SceneChoice> scene_fields() {
  using D = base::Declare<SceneChoice>;
  return {D::source("scene.source", &SceneChoice::source,
                    "spheres (as many as scene.objects), spheres:200 or hills:20000, or an .nff or "
                    ".obj file"),
          D::whole("scene.objects", &SceneChoice::objects, 1, 1e9, "",
                   "number of spheres in a generated scene")};
}

std::string scene_source(const SceneChoice& scene) {
  if (!has_own_objects(scene)) return fmt::format("spheres:{}", scene.objects);
  return scene.source.path.empty() ? scene.source.text : scene.source.path;
}

SceneSize size_of(const renderer::Scene& scene) { return {box_count(scene), object_count(scene)}; }

SceneSize size_of(const SceneChoice& scene) {
  static std::map<std::string, SceneSize> sizes;
  const auto source = scene_source(scene);
  const auto known = sizes.find(source);
  if (known != sizes.end()) return known->second;
  return sizes[source] = size_of(renderer::load_scene(source));
}

programs::Row describe(const SceneChoice& scene) {
  const auto all = static_cast<std::int64_t>(size_of(scene).objects);
  return {{"objects", scene_source(scene).starts_with("spheres:") ? all - 1 : all}};
}

std::string picture_key(const SceneChoice& scene, const renderer::Params& image) {
  const auto& p = image;
  const auto& s = p.sampling;
  return fmt::format("{} {}x{} {} {} {} {} {} {},{},{},{} {} {} {} {} {}", scene_source(scene),
                     p.width, p.height, p.limits.depth, p.limits.min_influence, int(p.feelers),
                     int(p.sample), p.ambient, p.area.x, p.area.y, p.area.width, p.area.height,
                     s.pixel_samples, s.adaptive, s.lens, s.shutter, s.seed);
}

std::string find_void(const SceneChoice& scene, const std::string& key) {
  return key == "scene.objects" && has_own_objects(scene) ? "scene.source" : "";
}

std::string picture_name(const SceneChoice& scene) {
  std::string name = std::filesystem::path(scene_source(scene)).filename().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return name;
}

}  // namespace ray_tracing

#pragma once
// The scene of a program that traces rays, [scene], and what its images are called and depend on.
#include "renderer/trace/params.hpp"
#include "simulator/declare/program.hpp"

namespace tracing {

struct SceneChoice {
  base::Source source{"spheres", ""};  ///< "spheres" stands for those of `objects`
  std::int64_t objects = 200;          ///< spheres of a generated scene
};
/// scene.source and scene.objects.
base::Fields<SceneChoice> scene_fields();

/// What renderer::load_scene takes: "spheres" and 200 objects are spheres:200.
std::string scene_source(const SceneChoice& scene);

/// Numbers of a scene's records.
struct SceneSize {
  std::size_t boxes = 0, objects = 0;
};
SceneSize size_of(const renderer::Scene& scene);
/// Kept for each scene: the points of a sweep share a few.
SceneSize size_of(const SceneChoice& scene);

// What a program declares of its scene, see programs::Program.

/// The column objects: spheres that are generated stand on a floor that is not counted.
programs::Row describe(const SceneChoice& scene);
/// What the image of a run depends on.
std::string picture_key(const SceneChoice& scene, const renderer::Params& image);
/// scene.source where it makes scene.objects void: it says itself how many there are.
std::string find_void(const SceneChoice& scene, const std::string& key);

/// How its pictures are called, "spheres-200": letters, digits and dashes.
std::string picture_name(const SceneChoice& scene);

}  // namespace tracing

#pragma once
// Scene of a ray tracing program, [scene], with names and keys of its images.
#include "renderer/trace/params.hpp"
#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

struct SceneChoice {
  base::Source source{"spheres", ""};  ///< "spheres": a generated scene of `objects` spheres
  std::int64_t objects = 200;          ///< spheres of a generated scene
};
/// scene.source and scene.objects.
base::Fields<SceneChoice> scene_fields();

/// Argument of renderer::load_scene: "spheres" and 200 objects give spheres:200.
std::string scene_source(const SceneChoice& scene);

/// Numbers of a scene's records.
struct SceneSize {
  std::size_t boxes = 0, objects = 0;
};
SceneSize size_of(const renderer::Scene& scene);
/// Cached by scene, since the points of a sweep share few scenes.
SceneSize size_of(const SceneChoice& scene);

// Declarations of a program on its scene, see programs::Program.

/// The column objects; the floor below generated spheres is not counted.
programs::Row describe(const SceneChoice& scene);
/// All parameters that determine the image of a run.
std::string picture_key(const SceneChoice& scene, const renderer::Params& image);
/// Returns "scene.source" for scene.objects if the source itself fixes their number; else "".
std::string find_void(const SceneChoice& scene, const std::string& key);

/// Name of its pictures, "spheres-200": letters, digits and dashes.
std::string picture_name(const SceneChoice& scene);

}  // namespace ray_tracing

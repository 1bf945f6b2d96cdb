#pragma once
// The scene of a ray tracing program, [scene], with names and keys of its images.
#include "renderer/trace/params.hpp"
#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

struct SceneChoice {
  base::Source source{"spheres", ""};  ///< "spheres" generates a scene with `objects` spheres
  std::int64_t objects = 200;          ///< number of spheres in a generated scene
};
/// The fields scene.source and scene.objects.
base::Fields<SceneChoice> scene_fields();

/// The argument for renderer::load_scene: "spheres" and 200 objects give "spheres:200".
std::string scene_source(const SceneChoice& scene);

/// Numbers of records in a scene.
struct SceneSize {
  std::size_t boxes = 0, objects = 0;
};
SceneSize size_of(const renderer::Scene& scene);
/// Caches the result, because the points of a sweep share few scenes.
SceneSize size_of(const SceneChoice& scene);

// Declarations that describe a program by its scene, see programs::Program.

/// The column "objects". It does not count the floor below generated spheres.
programs::Row describe(const SceneChoice& scene);
/// Text of all parameters that determine the image of a run.
std::string picture_key(const SceneChoice& scene, const renderer::Params& image);
/// If the source itself determines the number of objects, scene.objects has no effect: then returns
/// "scene.source" for this key. Otherwise returns "".
std::string find_void(const SceneChoice& scene, const std::string& key);

/// Name for pictures of the scene, such as "spheres-200": letters, digits and dashes.
std::string picture_name(const SceneChoice& scene);

}  // namespace ray_tracing

#pragma once
// The scene of a ray tracing program: the fields of the section [scene], and functions that depend
// on the scene.
#include "renderer/trace/params.hpp"
#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

struct SceneChoice {
  /// "spheres" stands for a generated scene of `objects` spheres.
  base::Source source{"spheres", ""};
  std::int64_t objects = 200;  ///< number of spheres in that scene
};
/// The fields scene.source and scene.objects.
base::Fields<SceneChoice> scene_fields();

/// The argument to pass to renderer::load_scene: "spheres:200" for "spheres" and 200 objects.
std::string scene_source(const SceneChoice& scene);

/// Numbers of records in a scene.
struct SceneSize {
  std::size_t boxes = 0, objects = 0;
};
SceneSize size_of(const renderer::Scene& scene);
/// Caches its results, because many points of a sweep have the same scene.
SceneSize size_of(const SceneChoice& scene);

// Functions for the declaration of a program (programs::Program) that depend on the scene.

/// The column "objects". Does not count the floor below generated spheres.
programs::Row describe(const SceneChoice& scene);
/// A text of all parameters that determine the image of a run.
std::string picture_key(const SceneChoice& scene, const renderer::Params& image);
/// If `key` is scene.objects and has no effect, because the source itself determines the number of
/// objects, returns "scene.source". Otherwise returns "".
std::string find_void(const SceneChoice& scene, const std::string& key);

/// Name for pictures of the scene, such as "spheres-200". It consists of letters, digits and
/// dashes.
std::string picture_name(const SceneChoice& scene);

}  // namespace ray_tracing

#include "renderer/scene/scene.hpp"

#include <fmt/format.h>

#include <numbers>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr double SELF_RELATIVE = 1e-10, BOX_RELATIVE = 1e-12;
constexpr std::size_t MAX_OBJECTS = std::size_t{1} << 30;

Tag make_tag(const Scene& scene) {
  require(!scene.surfaces.empty(), "a primitive", "a surface ('f') before the first primitive");
  if (scene.objects.size() >= MAX_OBJECTS)
    throw base::BadInput(fmt::format("found more objects, expected at most {}", MAX_OBJECTS));
  return {static_cast<std::uint32_t>(scene.objects.size()),
          static_cast<std::uint32_t>(scene.surfaces.size() - 1)};
}

Bounds make_bounds(const Scene& scene, Place place) {
  switch (place.kind()) {
    case Kind::sphere:
      return make_bounds(scene.spheres[place.index()]);
    case Kind::polygon:
      return make_bounds(scene.polygons[place.index()], scene.corners);
    case Kind::patch:
      return make_bounds(scene.patches[place.index()].flat, scene.corners);
    case Kind::cone:
      return make_bounds(scene.cones[place.index()]);
  }
  return {};
}

// Moves one kind's primitives into the order of the leaves.
template <typename Primitive>
void reorder(std::vector<Primitive>& primitives, Kind kind, Scene& scene) {
  std::vector<Primitive> sorted;
  sorted.reserve(primitives.size());
  for (Box& box : scene.hierarchy.boxes) {
    if (box.item == Box::INNER) continue;
    Place& place = scene.objects[box.item];
    if (place.kind() != kind) continue;
    sorted.push_back(primitives[place.index()]);
    place = Place::of(kind, sorted.size() - 1);
  }
  primitives = std::move(sorted);
}

}  // namespace

void add_sphere(Scene& scene, const Vec& centre, double radius) {
  scene.spheres.push_back(make_sphere(centre, radius, make_tag(scene)));
  scene.objects.push_back(Place::of(Kind::sphere, scene.spheres.size() - 1));
}

void add_polygon(Scene& scene, std::span<const Vec> corners) {
  scene.polygons.push_back(make_polygon(corners, make_tag(scene), scene.corners));
  scene.objects.push_back(Place::of(Kind::polygon, scene.polygons.size() - 1));
}

void add_patch(Scene& scene, std::span<const Vec> corners, std::span<const Vec> normals) {
  scene.patches.push_back(
      make_patch(corners, normals, make_tag(scene), scene.corners, scene.normals));
  scene.objects.push_back(Place::of(Kind::patch, scene.patches.size() - 1));
}

void add_cone(Scene& scene, const Vec& base, double base_radius, const Vec& apex,
              double apex_radius) {
  scene.cones.push_back(make_cone(base, base_radius, apex, apex_radius, make_tag(scene)));
  scene.objects.push_back(Place::of(Kind::cone, scene.cones.size() - 1));
}

// tan() in extended precision and rounded: the same double whichever library computes it.
View make_image_plane(View view) {
  require(view.angle > 0 && view.angle < 180, fmt::format("a view angle of {}", view.angle),
          "degrees between 0 and 180");
  require(length(view.at - view.from) > 0, "a view from the point it looks at",
          "'from' and 'at' apart");
  view.ahead = normalize(view.at - view.from);
  const Vec right = cross(view.ahead, view.up);
  require(length(right) > 1e-9 * length(view.up), "an up direction along the view",
          "'up' across the line from 'from' to 'at'");
  view.right = normalize(right);
  view.above = cross(view.right, view.ahead);
  view.half_height = static_cast<double>(
      std::tan(static_cast<long double>(view.angle) * std::numbers::pi_v<long double> / 360));
  return view;
}

void finish(Scene& scene) {
  scene.view = make_image_plane(scene.view);
  std::vector<Bounds> bounds;
  bounds.reserve(scene.objects.size());
  double scale = max_abs(scene.view.from);
  for (const Place place : scene.objects) {
    bounds.push_back(make_bounds(scene, place));
    scale = std::max({scale, max_abs(bounds.back().lo), max_abs(bounds.back().hi)});
  }
  scene.epsilon = SELF_RELATIVE * scale;
  for (Bounds& b : bounds) b = grow(b, BOX_RELATIVE * scale);
  scene.hierarchy = make_hierarchy(bounds);

  reorder(scene.spheres, Kind::sphere, scene);
  reorder(scene.polygons, Kind::polygon, scene);
  reorder(scene.patches, Kind::patch, scene);
  reorder(scene.cones, Kind::cone, scene);
  for (Box& box : scene.hierarchy.boxes)
    if (box.item != Box::INNER) box.item = scene.objects[box.item].bits;
}

}  // namespace renderer

#include "renderer/scene/scene.hpp"

#include <numbers>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr double BOX_RELATIVE = 1e-12, LEAST_ANGLE = 1e-9;
constexpr std::size_t MAX_OBJECTS = std::size_t{1} << 30;

bool has_mesh_texture(const Scene& scene) {
  const std::uint32_t texture = scene.surfaces.back().texture;
  return texture != NO_TEXTURE && scene.textures[texture].mapping.kind == Mapping::Kind::mesh;
}

// Makes the tag of a new object. `shape` names its kind in messages. `corners` is the number of its
// corners with texture coordinates.
Tag make_tag(const Scene& scene, std::string_view shape, std::size_t corners = 0) {
  require(!scene.surfaces.empty(), "a primitive", "a surface ('f') before the first primitive");
  require(scene.objects.size() < MAX_OBJECTS, "more objects",
          fmt::format("at most {}", MAX_OBJECTS));
  require(corners > 0 || !has_mesh_texture(scene), fmt::format("{} without coordinates", shape),
          "polygons with texture coordinates ('# uv'), because the surface's texture has the "
          "mapping mesh");
  return {static_cast<std::uint32_t>(scene.objects.size()),
          static_cast<std::uint32_t>(scene.surfaces.size() - 1)};
}

template <class Primitive>
void add(Scene& scene, Kind kind, std::vector<Primitive>& list, const Primitive& made) {
  list.push_back(made);
  scene.objects.push_back(Place::of(kind, list.size() - 1));
}

void check_coordinates(std::span<const Vec> corners, std::span<const Corner> coordinates) {
  require(coordinates.empty() || coordinates.size() == corners.size(),
          fmt::format("{} texture coordinates for {} vertices", coordinates.size(), corners.size()),
          "one pair for each vertex");
}

// Stores the texture coordinates of the corners of the polygon added last.
void add_coordinates(Scene& scene, std::span<const Corner> coordinates) {
  if (coordinates.empty() || !has_mesh_texture(scene)) return;
  scene.coordinates.resize(scene.corners.size() - coordinates.size());
  for (const auto& [u, v] : coordinates) scene.coordinates.push_back({u, v, 1});
}

// Sets the gradients of a polygon's texture coordinates. Fits a plane to the corners by least
// squares, which is exact for a triangle.
void set_gradients(TexturePoint& found, const Polygon& polygon,
                   std::span<const PolygonCorner> corners, std::span<const Vec> coordinates) {
  const double share = 1.0 / static_cast<double>(corners.size());
  Corner middle;
  Vec middle_of_texture;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    middle = {middle.u + share * corners[i].u, middle.v + share * corners[i].v};
    middle_of_texture += share * coordinates[i];
  }
  double uu = 0, uv = 0, vv = 0;
  Vec along_u, along_v;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double u = corners[i].u - middle.u, v = corners[i].v - middle.v;
    const Vec way = coordinates[i] - middle_of_texture;
    uu += u * u;
    uv += u * v;
    vv += v * v;
    along_u += u * way;
    along_v += v * way;
  }
  const double scale = 1 / (uu * vv - uv * uv);
  const Vec by_u = scale * (vv * along_u - uv * along_v);
  const Vec by_v = scale * (uu * along_v - uv * along_u);
  const auto to_scene = [&](double u, double v) {
    double at[3] = {};
    at[polygon.u] = u;
    at[polygon.v] = v;
    return Vec{at[0], at[1], at[2]};
  };
  found.grow_u = to_scene(by_u.x, by_v.x);
  found.grow_v = to_scene(by_u.y, by_v.y);
}

TexturePoint find_mesh_point(const Scene& scene, const Polygon& polygon, const Vec& point) {
  const auto coordinates = std::span(scene.coordinates).subspan(polygon.first, polygon.count);
  const Vec sum = interpolate(polygon, scene.corners, coordinates, point).sum;
  TexturePoint found{sum.x / sum.z, sum.y / sum.z};
  set_gradients(found, polygon, std::span(scene.corners).subspan(polygon.first, polygon.count),
                coordinates);
  return found;
}

Bounds make_bounds(const Scene& scene, Place place) {
  return visit(scene, place, [&](const auto& primitive) {
    if constexpr (requires { primitive.count; })
      return make_bounds(primitive, scene.corners);
    else
      return make_bounds(primitive);
  });
}

std::vector<Bounds> move_all(const std::vector<Bounds>& bounds, const std::vector<Vec>& moves) {
  std::vector<Bounds> moved;
  moved.reserve(bounds.size());
  for (std::size_t i = 0; i < bounds.size(); ++i)
    moved.push_back({bounds[i].lo + moves[i], bounds[i].hi + moves[i]});
  return moved;
}

// The smallest length of a vector that starts as `open` and changes linearly by `move`.
double eval_least_length(const Vec& open, const Vec& move) {
  const double square = dot(move, move);
  const double time = square > 0 ? std::clamp(-dot(open, move) / square, 0.0, 1.0) : 0.0;
  return length(open + time * move);
}

// Throws BadInput unless the view stays valid until the shutter closes. Callers have checked that
// it is valid when the shutter opens.
void check_motion(const View& view) {
  const Vec open = view.at - view.from, move = view.at_move - view.from_move;
  const double longest = std::max(length(open), length(open + move));
  require(eval_least_length(open, move) > LEAST_ANGLE * longest,
          "a view whose 'from' and 'at' meet while the shutter is open",
          "different points 'from' and 'at'");
  require(eval_least_length(cross(open, view.up), cross(move, view.up)) >
              LEAST_ANGLE * length(view.up) * longest,
          "a view that turns along the up direction while the shutter is open",
          "an 'up' that is not parallel to the line from 'from' to 'at'");
}

// Sorts the primitives of one kind into the order of the hierarchy's leaves.
template <class Primitive>
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
  add(scene, Kind::sphere, scene.spheres, make_sphere(centre, radius, make_tag(scene, "a sphere")));
}

void add_polygon(Scene& scene, std::span<const Vec> corners, std::span<const Corner> coordinates) {
  check_coordinates(corners, coordinates);
  const Tag tag = make_tag(scene, "a polygon", coordinates.size());
  add(scene, Kind::polygon, scene.polygons, make_polygon(corners, tag, scene.corners));
  add_coordinates(scene, coordinates);
}

void add_patch(Scene& scene, std::span<const Vec> corners, std::span<const Vec> normals,
               std::span<const Corner> coordinates) {
  check_coordinates(corners, coordinates);
  const Tag tag = make_tag(scene, "a polygon", coordinates.size());
  add(scene, Kind::patch, scene.patches,
      make_patch(corners, normals, tag, scene.corners, scene.normals));
  add_coordinates(scene, coordinates);
}

void add_cone(Scene& scene, const Vec& base, double base_radius, const Vec& apex,
              double apex_radius) {
  add(scene, Kind::cone, scene.cones,
      make_cone(base, base_radius, apex, apex_radius, make_tag(scene, "a cone")));
}

void point(View& view) {
  view.ahead = normalize(view.at - view.from);
  view.right = normalize(cross(view.ahead, view.up));
  view.above = cross(view.right, view.ahead);
}

// Rounds tan() from extended precision, so that every maths library gives the same double.
View make_image_plane(View view) {
  require(view.angle > 0 && view.angle < 180, fmt::format("a view angle of {}", view.angle),
          "degrees between 0 and 180");
  require(length(view.at - view.from) > 0, "a view from the point it looks at",
          "different points 'from' and 'at'");
  require(length(cross(normalize(view.at - view.from), view.up)) > LEAST_ANGLE * length(view.up),
          "an up direction along the view",
          "an 'up' that is not parallel to the line from 'from' to 'at'");
  point(view);
  view.half_height = static_cast<double>(
      std::tan(static_cast<long double>(view.angle) * std::numbers::pi_v<long double> / 360));
  return view;
}

TexturePoint find_texture_point(const Scene& scene, const Texture& texture, std::uint32_t object,
                                const Vec& point) {
  if (texture.mapping.kind != Mapping::Kind::mesh)
    return eval_mapping(texture.mapping,
                        scene.displacements.empty() ? point : point - scene.displacements[object]);
  return visit(scene, scene.objects[object], [&](const auto& primitive) {
    if constexpr (requires { primitive.count; })
      return find_mesh_point(scene, primitive, point);
    else
      return TexturePoint{};  // only polygons have texture coordinates
  });
}

void translate(Scene& scene, std::uint32_t object, const Vec& by) {
  scene.displacements.resize(object_count(scene));
  scene.displacements[object] += by;
  const Place place = scene.objects[object];
  switch (place.kind()) {
    case Kind::sphere:
      return translate(scene.spheres[place.index()], by);
    case Kind::polygon:
      return translate(scene.polygons[place.index()], by, scene.corners);
    case Kind::patch:
      return translate(scene.patches[place.index()], by, scene.corners);
    case Kind::cone:
      return translate(scene.cones[place.index()], by);
  }
}

void finish(Scene& scene) {
  View& view = scene.view = make_image_plane(scene.view);
  view.has_motion = !scene.moves.empty() || view.from_move != Vec{} || view.at_move != Vec{};
  if (view.has_motion) check_motion(view);
  std::vector<Bounds> bounds;
  bounds.reserve(scene.objects.size());
  for (const Place place : scene.objects) bounds.push_back(make_bounds(scene, place));
  std::vector<Bounds> at_close;
  if (!scene.moves.empty()) at_close = move_all(bounds, scene.moves);

  double scale = std::max(max_abs(view.from), max_abs(view.from + view.from_move)) +
                 0.5 * MAX_LENS * view.lens.aperture;
  for (const auto* all : {&bounds, &at_close})
    for (const Bounds& b : *all) scale = std::max({scale, max_abs(b.lo), max_abs(b.hi)});
  scene.epsilon = SELF_RELATIVE * scale;
  double smallest = scale;
  for (const Bounds& b : bounds) smallest = std::min(smallest, max_abs(b.hi - b.lo));
  scene.least_epsilon = SELF_RELATIVE * smallest;
  for (auto* all : {&bounds, &at_close})
    for (Bounds& b : *all) b = grow(b, BOX_RELATIVE * scale);
  scene.hierarchy = scene.moves.empty() ? make_hierarchy(bounds) : make_hierarchy(bounds, at_close);

  reorder(scene.spheres, Kind::sphere, scene);
  reorder(scene.polygons, Kind::polygon, scene);
  reorder(scene.patches, Kind::patch, scene);
  reorder(scene.cones, Kind::cone, scene);
  for (Box& box : scene.hierarchy.boxes)
    if (box.item != Box::INNER) box.item = scene.objects[box.item].bits;
}

}  // namespace renderer

#include "renderer/scene/primitives.hpp"

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

// tolerances relative to a polygon's size, and to its square
constexpr double MAX_BEND = 0.05, MIN_AREA = 1e-12;

// Newell's method, which is correct for any simple polygon, also concave or only nearly flat ones.
Vec eval_newell_normal(std::span<const Vec> corners, const Vec& centre) {
  Vec sum;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    sum += cross(corners[j] - centre, corners[i] - centre);
  return sum;
}

}  // namespace

Sphere make_sphere(const Vec& centre, double radius, Tag tag) {
  require(radius > 0, fmt::format("a sphere of radius {}", radius), "a radius > 0");
  return {centre, radius, tag};
}

Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<Corner>& pool) {
  require(corners.size() >= 3, fmt::format("a polygon of {} vertices", corners.size()),
          "3 or more");
  Vec centre;
  for (const Vec& p : corners) centre += (1.0 / static_cast<double>(corners.size())) * p;
  const Bounds box = make_bounds(corners);
  const double size = max_abs(box.hi - box.lo);
  const Vec newell = eval_newell_normal(corners, centre);
  require(length(newell) > MIN_AREA * size * size, "a polygon without area",
          "vertices that are not all on one line");

  Polygon made;
  made.normal = normalize(newell);
  made.offset = dot(made.normal, centre);
  for (const Vec& p : corners)
    require(std::abs(dot(made.normal, p) - made.offset) <= MAX_BEND * size,
            "a polygon that is not flat", "vertices in one plane, within 5 % of its size");
  made.tag = tag;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(made.normal[axis]) > std::abs(made.normal[made.w]))
      made.w = static_cast<std::uint8_t>(axis);
  made.u = static_cast<std::uint8_t>((made.w + 1) % 3);
  made.v = static_cast<std::uint8_t>((made.w + 2) % 3);
  made.first = static_cast<std::uint32_t>(pool.size());
  made.count = static_cast<std::uint32_t>(corners.size());
  for (const Vec& p : corners) pool.push_back({p[made.u], p[made.v]});
  return made;
}

Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<Corner>& pool, std::vector<Vec>& normal_pool) {
  require(corners.size() == corner_normals.size(),
          fmt::format("{} normals for {} vertices", corner_normals.size(), corners.size()),
          "one each");
  Patch made{make_polygon(corners, tag, pool), static_cast<std::uint32_t>(normal_pool.size())};
  Vec sum;
  for (const Vec& n : corner_normals) {
    require(length(n) > 0, "a normal of length 0", "a direction");
    normal_pool.push_back(normalize(n));
    sum += normal_pool.back();
  }
  if (dot(sum, made.normal) < 0) {
    made.normal = -made.normal;
    made.offset = -made.offset;
  }
  return made;
}

void check_polygon(std::span<const Vec> corners, std::span<const Vec> corner_normals) {
  std::vector<Corner> pool;
  std::vector<Vec> normal_pool;
  if (corner_normals.empty())
    make_polygon(corners, {}, pool);
  else
    make_patch(corners, corner_normals, {}, pool, normal_pool);
}

Cone make_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius, Tag tag) {
  require(base_radius >= 0 && apex_radius >= 0,
          fmt::format("a cone of radii {} and {}", base_radius, apex_radius), "radii >= 0");
  require(base_radius + apex_radius > 0, "a cone of radii 0 and 0", "one radius > 0");
  const double height = length(apex - base);
  require(height > 0, "a cone whose ends coincide", "two different end points");
  return {base, normalize(apex - base), height, base_radius, (apex_radius - base_radius) / height,
          tag};
}

Vec eval_corner(const Polygon& polygon, const Corner& c) {
  const double w =
      (polygon.offset - polygon.normal[polygon.u] * c.u - polygon.normal[polygon.v] * c.v) /
      polygon.normal[polygon.w];
  return polygon.w == 0 ? Vec{w, c.u, c.v} : polygon.w == 1 ? Vec{c.v, w, c.u} : Vec{c.u, c.v, w};
}

void translate(Sphere& sphere, const Vec& by) { sphere.centre += by; }

void translate(Polygon& polygon, const Vec& by, std::vector<Corner>& pool) {
  polygon.offset += dot(polygon.normal, by);
  for (Corner& c : std::span(pool).subspan(polygon.first, polygon.count))
    c = {c.u + by[polygon.u], c.v + by[polygon.v]};
}

void translate(Cone& cone, const Vec& by) { cone.base += by; }

Bounds make_bounds(const Sphere& sphere) {
  return grow({sphere.centre, sphere.centre}, sphere.radius);
}

Bounds make_bounds(const Polygon& polygon, std::span<const Corner> pool) {
  Bounds box;
  for (const Corner& c : pool.subspan(polygon.first, polygon.count))
    box = join(box, eval_corner(polygon, c));
  return box;
}

Bounds make_bounds(const Cone& cone) {
  // A disc of radius r perpendicular to the unit axis a extends r * sqrt(1 - a_i^2) along
  // coordinate i.
  const Vec& a = cone.axis;
  const auto reach = [](double c) { return std::sqrt(std::max(0.0, 1 - c * c)); };
  const Vec across{reach(a.x), reach(a.y), reach(a.z)};
  const Vec apex = cone.base + cone.height * a;
  const double apex_radius = std::max(0.0, cone.base_radius + cone.slope * cone.height);
  return join(Bounds{cone.base - cone.base_radius * across, cone.base + cone.base_radius * across},
              Bounds{apex - apex_radius * across, apex + apex_radius * across});
}

Vec eval_normal(const Cone& c, const Vec& point) {
  const double along = dot(point - c.base, c.axis);
  const Vec across = point - c.base - along * c.axis;
  const double radius = length(across);
  if (radius == 0) return c.axis;
  return normalize((1 / radius) * across - c.slope * c.axis);
}

Blend interpolate(const Polygon& polygon, std::span<const Corner> pool, std::span<const Vec> values,
                  const Vec& point) {
  const auto corners = pool.subspan(polygon.first, polygon.count);
  const double pu = point[polygon.u], pv = point[polygon.v];
  const auto spoke = [&](std::size_t i) { return Corner{corners[i].u - pu, corners[i].v - pv}; };
  const auto size = [](const Corner& c) { return std::sqrt(c.u * c.u + c.v * c.v); };

  Vec sum;
  for (std::size_t i = polygon.count - 1, j = 0; j < polygon.count; i = j++) {
    const Corner a = spoke(i), b = spoke(j);
    const Vec &value_a = values[i], &value_b = values[j];
    const double a_size = size(a), b_size = size(b);
    if (a_size == 0) return {value_a, Blend::On::corner};
    if (b_size == 0) return {value_b, Blend::On::corner};
    const double below = a_size * b_size + a.u * b.u + a.v * b.v;
    // On an edge, the value is linear between its ends.
    if (!(below > 0)) return {b_size * value_a + a_size * value_b, Blend::On::edge};
    // tangent of half the angle subtended by the edge
    const double half_tan = (a.u * b.v - a.v * b.u) / below;
    sum += (half_tan / a_size) * value_a + (half_tan / b_size) * value_b;
  }
  return {sum};
}

Vec eval_smooth_normal(const Patch& patch, std::span<const Corner> pool,
                       std::span<const Vec> normal_pool, const Vec& point) {
  auto [sum, on] = interpolate(patch, pool, normal_pool.subspan(patch.normals, patch.count), point);
  if (on == Blend::On::corner) return sum;
  if (on == Blend::On::edge) return normalize(sum);
  if (dot(sum, patch.normal) < 0) sum = -sum;
  const double norm = length(sum);
  return norm > 0 && norm < Bounds::INF ? (1 / norm) * sum : patch.normal;
}

}  // namespace renderer

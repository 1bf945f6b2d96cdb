#include "renderer/scene/primitives.hpp"

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

// Tolerances relative to a polygon's size (MAX_BEND, FLAT) and to its square (MIN_AREA).
constexpr double MAX_BEND = 0.05, FLAT = 1e-6, MIN_AREA = 1e-12;

// Generous bound on the rounding error of a ray's intersection test, relative to the largest
// coordinate.
constexpr double ROUNDING = 64 * std::numeric_limits<double>::epsilon();
// Limits of pull_inside(), relative to a polygon's longest edge: the distance from an edge at which
// it moves points to, and the length of its displacement.
constexpr double MAX_PULL = 1e-3, MAX_WAY = 1e-2;
// Two edges count as parallel if the sine of the angle between them is smaller than this.
constexpr double SHARPEST = 1e-3;

// Newell's method. It is correct for any simple polygon, even a concave or a nearly flat one.
Vec eval_newell_normal(std::span<const Vec> corners, const Vec& centre) {
  Vec sum;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
    sum += cross(corners[j] - centre, corners[i] - centre);
  return sum;
}

// True if all corners turn to the same side, and the border goes up once and down once.
bool is_convex(std::span<const PolygonCorner> corners) {
  const std::size_t n = corners.size();
  const auto rise = [&](std::size_t i) { return corners[(i + 1) % n].v - corners[i % n].v; };
  const auto run = [&](std::size_t i) { return corners[(i + 1) % n].u - corners[i % n].u; };
  std::size_t left = 0, right = 0, climbs = 0;
  bool was_up = false;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const double turn = run(i) * rise(i + 1) - rise(i) * run(i + 1);
    left += turn > 0;
    right += turn < 0;
    const bool up = rise(i) != 0 ? rise(i) > 0 : was_up;
    climbs += up && !was_up && i >= n;
    was_up = up;
  }
  return (left == 2 * n || right == 2 * n) && climbs <= 1;
}

// Computes the edges of a polygon from its corners.
void set_edges(std::span<PolygonCorner> corners) {
  const PolygonCorner& first = corners.front();
  PolygonCorner* last = &corners.back();
  double area = 0;
  for (PolygonCorner& corner : corners) {
    area += (last->u - first.u) * (corner.v - first.v) - (corner.u - first.u) * (last->v - first.v);
    last = &corner;
  }
  for (PolygonCorner& corner : corners) {
    const double u = last->v - corner.v, v = corner.u - last->u, length = std::sqrt(u * u + v * v);
    const double by = length > 0 ? std::copysign(1 / length, area) : 0;
    last->edge = {by * u, by * v, by * u * corner.u + by * v * corner.v};
    last = &corner;
  }
}

// Sets the fields of a polygon that decide which rays need intersect_closely().
void set_limits(Polygon& polygon, std::span<const Vec> corners, const Bounds& box, double size) {
  double bend = 0;
  for (const Vec& p : corners)
    bend = std::max(bend, std::abs(dot(polygon.normal, p) - polygon.offset));
  const double largest = std::max(max_abs(box.lo), max_abs(box.hi));
  const bool flat = bend <= FLAT * size + ROUNDING * largest;
  if (!flat) polygon.shape = Shape::bent;
  polygon.slack = flat ? 2 * bend + CLOSE * largest : NO_HIT;
}

}  // namespace

Sphere make_sphere(const Vec& centre, double radius, Tag tag) {
  require(radius > 0, fmt::format("a sphere of radius {}", radius), "a radius > 0");
  return {centre, radius, tag};
}

Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<PolygonCorner>& pool) {
  require(corners.size() >= 3, fmt::format("a polygon of {} vertices", corners.size()),
          "3 or more");
  Vec centre;
  for (const Vec& p : corners) centre += (1.0 / static_cast<double>(corners.size())) * p;
  const Bounds box = make_bounds(corners);
  const double size = max_abs(box.hi - box.lo);
  const Vec newell = eval_newell_normal(corners, centre);
  require(length(newell) > MIN_AREA * size * size, "a polygon with area 0",
          "vertices that are not collinear");

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
  for (const Vec& p : corners) pool.push_back({{{p[made.u], p[made.v]}, p[made.w]}, {}});
  const auto placed = std::span(pool).last(corners.size());
  set_edges(placed);
  if (is_convex(placed)) made.shape = Shape::convex;
  set_limits(made, corners, box, size);
  return made;
}

Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<PolygonCorner>& pool, std::vector<Vec>& normal_pool) {
  require(corners.size() == corner_normals.size(),
          fmt::format("{} normals for {} vertices", corner_normals.size(), corners.size()),
          "one normal for each vertex");
  Patch made{make_polygon(corners, tag, pool), static_cast<std::uint32_t>(normal_pool.size())};
  Vec sum;
  for (const Vec& n : corner_normals) {
    require(length(n) > 0, "a normal of length 0", "a non-zero length");
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
  std::vector<PolygonCorner> pool;
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
  require(height > 0, "a cone with coinciding ends", "two different end points");
  return {base, normalize(apex - base), height, base_radius, (apex_radius - base_radius) / height,
          tag};
}

Vec eval_corner(const Polygon& polygon, const Corner3& c) {
  return polygon.w == 0   ? Vec{c.w, c.u, c.v}
         : polygon.w == 1 ? Vec{c.v, c.w, c.u}
                          : Vec{c.u, c.v, c.w};
}

void translate(Sphere& sphere, const Vec& by) { sphere.centre += by; }

void translate(Polygon& polygon, const Vec& by, std::vector<PolygonCorner>& pool) {
  polygon.offset += dot(polygon.normal, by);
  const auto corners = std::span(pool).subspan(polygon.first, polygon.count);
  for (Corner3& c : corners) c = {{c.u + by[polygon.u], c.v + by[polygon.v]}, c.w + by[polygon.w]};
  set_edges(corners);
  polygon.slack += CLOSE * max_abs(by);
}

void translate(Cone& cone, const Vec& by) { cone.base += by; }

Bounds make_bounds(const Sphere& sphere) {
  return grow({sphere.centre, sphere.centre}, sphere.radius);
}

Bounds make_bounds(const Polygon& polygon, std::span<const PolygonCorner> pool) {
  Bounds box;
  for (const Corner3& c : pool.subspan(polygon.first, polygon.count))
    box = join(box, eval_corner(polygon, c));
  return box;
}

Bounds make_bounds(const Cone& cone) {
  // A disc of the radius r, perpendicular to the unit axis a, extends r * sqrt(1 - a_i^2) along
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

namespace {

// Computes interpolate(). `spoke(i)` is the vector from the point to corner i, and `value(i)` is
// the value at this corner.
template <class Spoke, class Value>
Blend blend(std::size_t count, const Spoke& spoke, const Value& value) {
  const auto size = [](const Corner& c) { return std::sqrt(c.u * c.u + c.v * c.v); };
  Vec sum;
  for (std::size_t i = count - 1, j = 0; j < count; i = j++) {
    const Corner a = spoke(i), b = spoke(j);
    const Vec value_a = value(i), value_b = value(j);
    const double a_size = size(a), b_size = size(b);
    if (a_size == 0) return {value_a, Blend::On::corner};
    if (b_size == 0) return {value_b, Blend::On::corner};
    const double below = a_size * b_size + a.u * b.u + a.v * b.v;
    // On an edge, the value is linear between the ends of the edge.
    if (!(below > 0)) return {b_size * value_a + a_size * value_b, Blend::On::edge};
    // tangent of half the angle that the edge spans as seen from the point
    const double half_tan = (a.u * b.v - a.v * b.u) / below;
    sum += (half_tan / a_size) * value_a + (half_tan / b_size) * value_b;
  }
  return {sum};
}

// Coordinates whose third axis is a ray: (u, v) across the ray, 0 on the ray, and the distance w
// along it. The coordinates of a corner depend only on the ray and the corner, so that all faces
// with this corner get equal values.
struct RayAxes {
  RayAxes(const Vec& origin, const Vec& direction) {
    if (std::abs(direction.y) > std::abs(direction.x)) w = 1;
    if (std::abs(direction.z) > std::abs(direction[w])) w = 2;
    u = (w + 1) % 3;
    v = (w + 2) % 3;
    start = {{origin[u], origin[v]}, origin[w]};
    shear_u = direction[u] / direction[w];
    shear_v = direction[v] / direction[w];
    inverse = 1 / direction[w];
  }
  Corner3 operator()(const Vec& p) const {
    const double ahead = p[w] - start.w;
    return {{p[u] - start.u - shear_u * ahead, p[v] - start.v - shear_v * ahead}, inverse * ahead};
  }

  int u = 1, v = 2, w = 0;
  Corner3 start;
  double shear_u, shear_v, inverse;
};

// True if the edge from p to q crosses the half-line v = 0, u > 0. The result does not depend on
// the direction of the edge.
bool crosses(const Corner& p, const Corner& q) {
  if ((p.v > 0) == (q.v > 0)) return false;
  const Corner &a = p.v > 0 ? q : p, &b = p.v > 0 ? p : q;
  return a.u * b.v - b.u * a.v > 0;
}

// The point of the edge that is nearest to (u, v) = (0, 0), with its distance along the ray.
Corner3 find_nearest(const Corner3& a, const Corner3& b) {
  const double u = b.u - a.u, v = b.v - a.v, square = u * u + v * v;
  const double share = square > 0 ? std::clamp(-(a.u * u + a.v * v) / square, 0.0, 1.0) : 0;
  return {{a.u + share * u, a.v + share * v}, a.w + share * (b.w - a.w)};
}

struct EdgeHits {
  bool inside = false;      // the even-odd rule finds the ray inside the polygon
  double on_edge = NO_HIT;  // distance along the ray to the nearest edge that it meets
};

// Tests a ray against the edges between the corners at(0), at(1) ... of a polygon. Of the faces at
// a shared edge, the even-odd rule finds exactly one: it has an odd number of crossings. If the ray
// meets the edge itself, within the tolerance, it meets all faces at this edge.
EdgeHits meet_edges(std::size_t count, const auto& at, double tolerance, double epsilon) {
  EdgeHits found;
  Corner3 last = at(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Corner3 corner = at(i), nearest = find_nearest(last, corner);
    if (std::max(std::abs(nearest.u), std::abs(nearest.v)) <= tolerance && nearest.w > epsilon)
      found.on_edge = std::min(found.on_edge, nearest.w);
    found.inside ^= crosses(last, corner);
    last = corner;
  }
  return found;
}

}  // namespace

double intersect_closely(const Polygon& polygon, const PolygonCorner* pool, const Vec& origin,
                         const Vec& direction, double epsilon) {
  const double along = dot(polygon.normal, direction);
  const double height = polygon.offset - dot(polygon.normal, origin);
  double distance = height / along;
  const bool is_ahead = distance > epsilon && distance < NO_HIT;
  if (!is_ahead && !(std::abs(height) <= polygon.slack + eval_closeness(epsilon))) return NO_HIT;
  const RayAxes axes(origin, direction);
  const auto at = [&](std::size_t i) {
    return axes(eval_corner(polygon, pool[polygon.first + i]));
  };
  double largest = max_abs(origin), least = NO_HIT, most = -NO_HIT;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const double depth = at(i).w;
    largest = std::max(largest, max_abs(eval_corner(polygon, pool[polygon.first + i])));
    least = std::min(least, depth);
    most = std::max(most, depth);
  }
  if (!(most > epsilon)) return NO_HIT;

  const auto [inside, on_edge] = meet_edges(polygon.count, at, ROUNDING * largest, epsilon);
  if (!inside && on_edge == NO_HIT) return NO_HIT;
  if (polygon.shape == Shape::bent || std::abs(along) <= EDGE_ON) {
    if (on_edge < NO_HIT) return on_edge;
    const Vec sum = blend(polygon.count, at, [&](std::size_t i) { return Vec{at(i).w, 1, 0}; }).sum;
    distance = sum.x / sum.y;
  }
  distance = distance >= least ? std::min(distance, most) : least;
  return distance > epsilon ? distance : NO_HIT;
}

namespace {

// One or two edges that are close to a point: their first corners, and their unit normals in the
// plane (u, v), which point inwards.
struct CloseEdges {
  std::size_t corner[2];
  Corner normal[2];
  int count = 0;
};

// Adds to `edges` an edge that is nearer than `margin` to the point `at`. Returns false if there is
// no further one.
bool add_close_edge(std::span<const PolygonCorner> corners, const Corner& at, double margin,
                    CloseEdges& edges) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PolygonCorner &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Corner3 nearest = find_nearest({{a.u - at.u, a.v - at.v}}, {{b.u - at.u, b.v - at.v}});
    const bool has_length = a.edge.normal_u != 0 || a.edge.normal_v != 0;
    if (!has_length || !(nearest.u * nearest.u + nearest.v * nearest.v < margin * margin)) continue;
    if (edges.count == 1 && edges.corner[0] == i) continue;
    edges.corner[edges.count] = i;
    edges.normal[edges.count++] = {a.edge.normal_u, a.edge.normal_v};
    return true;
  }
  return false;
}

// The displacement by which the distance from the edges grows by `margin`. At a corner, it is along
// the bisector. Between two parallel edges, it is 0.
Corner find_way_inside(const CloseEdges& edges, double margin) {
  const auto& [a, b] = edges.normal;
  if (edges.count == 1) return {margin * a.u, margin * a.v};
  const double sine = a.u * b.v - a.v * b.u;
  if (std::abs(sine) >= SHARPEST) return {margin * (b.v - a.v) / sine, margin * (a.u - b.u) / sine};
  return a.u * b.u + a.v * b.v > 0 ? Corner{margin * a.u, margin * a.v} : Corner{};
}

}  // namespace

Vec pull_inside(const Polygon& polygon, const PolygonCorner* pool, const Vec& point,
                double epsilon) {
  const std::span corners(pool + polygon.first, polygon.count);
  const Corner3 at{{point[polygon.u], point[polygon.v]}, point[polygon.w]};
  double span = 0;
  const Corner* last = &corners.back();
  for (const Corner& c : corners) {
    span = std::max(span, std::abs(last->u - c.u) + std::abs(last->v - c.v));
    last = &c;
  }
  const double margin = std::min(EDGE_MARGIN * epsilon, MAX_PULL * span);
  CloseEdges edges;
  Corner way;
  // At a sharp corner, the displacement from one edge can lead close to another one.
  while (edges.count < 2 && add_close_edge(corners, {at.u + way.u, at.v + way.v}, margin, edges)) {
    way = find_way_inside(edges, margin);
    const double size = std::sqrt(way.u * way.u + way.v * way.v);
    if (size > MAX_WAY * span) way = {MAX_WAY * span / size * way.u, MAX_WAY * span / size * way.v};
  }
  const double slope = (polygon.normal[polygon.u] * way.u + polygon.normal[polygon.v] * way.v) /
                       polygon.normal[polygon.w];
  return eval_corner(polygon, {{at.u + way.u, at.v + way.v}, at.w - slope});
}

Blend interpolate(const Polygon& polygon, std::span<const PolygonCorner> pool,
                  std::span<const Vec> values, const Vec& point) {
  const auto corners = pool.subspan(polygon.first, polygon.count);
  const double pu = point[polygon.u], pv = point[polygon.v];
  return blend(
      polygon.count,
      [&](std::size_t i) {
        return Corner{corners[i].u - pu, corners[i].v - pv};
      },
      [&](std::size_t i) { return values[i]; });
}

Vec eval_smooth_normal(const Patch& patch, std::span<const PolygonCorner> pool,
                       std::span<const Vec> normal_pool, const Vec& point) {
  auto [sum, on] = interpolate(patch, pool, normal_pool.subspan(patch.normals, patch.count), point);
  if (on == Blend::On::corner) return sum;
  if (on == Blend::On::edge) return normalize(sum);
  if (dot(sum, patch.normal) < 0) sum = -sum;
  const double norm = length(sum);
  return norm > 0 && norm < Bounds::INF ? (1 / norm) * sum : patch.normal;
}

}  // namespace renderer

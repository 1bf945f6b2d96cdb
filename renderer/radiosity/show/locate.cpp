#include "renderer/radiosity/show/locate.hpp"

#include "renderer/scene/kernels.hpp"

namespace radiosity {

namespace {

Corner operator-(const Corner& a, const Corner& b) { return {a.u - b.u, a.v - b.v}; }
Corner operator*(double s, const Corner& a) { return {s * a.u, s * a.v}; }
double cross(const Corner& a, const Corner& b) { return a.u * b.v - a.v * b.u; }
double dot(const Corner& a, const Corner& b) { return a.u * b.u + a.v * b.v; }

const renderer::Polygon& get_polygon(const Mesh& mesh, std::uint32_t object) {
  return mesh.blockers.polygons[mesh.blockers.objects[object].index()];
}

std::array<Corner, 4> project(const Mesh& mesh, const Patch& patch, const renderer::Polygon& on) {
  std::array<Corner, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec& at = mesh.vertices[patch.corners[k]].at;
    corners[k] = {at[on.u], at[on.v]};
  }
  return corners;
}

struct Box {
  Corner lo{renderer::NO_HIT, renderer::NO_HIT}, hi{-renderer::NO_HIT, -renderer::NO_HIT};
  void add(const Corner& c) {
    lo = {std::min(lo.u, c.u), std::min(lo.v, c.v)};
    hi = {std::max(hi.u, c.u), std::max(hi.v, c.v)};
  }
};

Box make_box(const std::array<Corner, 4>& corners) {
  Box box;
  for (const Corner& c : corners) box.add(c);
  return box;
}

// The number of the cell along one coordinate; the nearest one if `at` is outside.
int find_cell(double at, double lo, double cell, int across) {
  return static_cast<int>(std::clamp((at - lo) / cell, 0.0, across - 1.0));
}

void make_grid(const Mesh& mesh, Sides::Side& side, const renderer::Polygon& polygon) {
  std::vector<Box> boxes;
  Box all;
  for (const auto patch : side.patches) {
    boxes.push_back(make_box(project(mesh, mesh.patches[patch], polygon)));
    all.add(boxes.back().lo);
    all.add(boxes.back().hi);
  }
  side.across = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(boxes.size()))));
  side.lo = all.lo;
  side.cell = (1.0 / side.across) * (all.hi - all.lo);
  side.cells.resize(static_cast<std::size_t>(side.across) * static_cast<std::size_t>(side.across));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto u = [&](const Corner& c) {
      return find_cell(c.u, side.lo.u, side.cell.u, side.across);
    };
    const auto v = [&](const Corner& c) {
      return find_cell(c.v, side.lo.v, side.cell.v, side.across);
    };
    for (int y = v(boxes[i].lo); y <= v(boxes[i].hi); ++y)
      for (int x = u(boxes[i].lo); x <= u(boxes[i].hi); ++x)
        side.cells[static_cast<std::size_t>(y * side.across + x)].push_back(side.patches[i]);
  }
}

}  // namespace

// Q = s E + t F + s t G; without s: cross(Q - t F, E + t G) = a t^2 + b t + c = 0. In a quad that
// runs counter-clockwise the quadratic grows at the root within, as the map's Jacobian is positive.
Corner invert_bilinear(const std::array<Corner, 4>& corners, const Corner& point) {
  const Corner e = corners[1] - corners[0], f = corners[3] - corners[0];
  const Corner g = corners[2] - corners[1] - f, q = point - corners[0];
  const bool turned = cross(corners[2] - corners[0], corners[3] - corners[1]) < 0;
  const double sign = turned ? -1 : 1;
  const double a = sign * cross(g, f), b = sign * (cross(q, g) + cross(e, f)),
               c = sign * cross(q, e);
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  const double t = b >= 0 ? (b + root > 0 ? -2 * c / (b + root) : 0) : (root - b) / (2 * a);
  const Corner along{e.u + t * g.u, e.v + t * g.v};
  const double square = dot(along, along);
  return {square > 0 ? dot(q - t * f, along) / square : 0.5, t};
}

Sides make_sides(const Mesh& mesh) {
  Sides made;
  made.sides.resize(2 * object_count(mesh.blockers));
  const auto side_of = [&](std::uint32_t object, const Vec& normal) -> Sides::Side& {
    const bool back = dot(normal, get_polygon(mesh, object).normal) < 0;
    return made.sides[2 * object + (back ? 1 : 0)];
  };
  for (std::uint32_t i = 0; i < mesh.mirrors.size(); ++i) {
    auto& side = side_of(mesh.mirrors[i].object, mesh.mirrors[i].normal);
    side.kind = Sides::Kind::mirror;
    side.mirror = i;
  }
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    auto& side = side_of(mesh.patches[i].object, mesh.patches[i].normal);
    side.kind = Sides::Kind::patches;
    side.patches.push_back(i);
  }
  for (std::uint32_t i = 0; i < made.sides.size(); ++i)
    if (made.sides[i].kind == Sides::Kind::patches)
      make_grid(mesh, made.sides[i], get_polygon(mesh, i / 2));
  return made;
}

Spot locate(const Mesh& mesh, const Sides::Side& side, std::uint32_t object, const Vec& point,
            renderer::Work& work) {
  constexpr double SLACK = 1e-9;
  const auto& polygon = get_polygon(mesh, object);
  const Corner at{point[polygon.u], point[polygon.v]};
  const int x = find_cell(at.u, side.lo.u, side.cell.u, side.across);
  const int y = find_cell(at.v, side.lo.v, side.cell.v, side.across);
  const auto& near = side.cells[static_cast<std::size_t>(y * side.across + x)];
  Spot best;
  double least = renderer::NO_HIT;  // how far outside
  // (A cell that no patch touches is beyond the border of a face that is no rectangle.)
  for (const auto patch : near.empty() ? side.patches : near) {
    work[renderer::Op::polygon_edges] += 1;
    const auto [s, t] = invert_bilinear(project(mesh, mesh.patches[patch], polygon), at);
    const double outside = std::max({0.0, -s, s - 1, -t, t - 1});
    if (!(outside < least)) continue;
    best = {patch, std::clamp(s, 0.0, 1.0), std::clamp(t, 0.0, 1.0)};
    least = outside;
    if (outside <= SLACK) break;
  }
  return best;
}

}  // namespace radiosity

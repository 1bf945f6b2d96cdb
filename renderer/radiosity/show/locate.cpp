#include "renderer/radiosity/show/locate.hpp"

namespace radiosity {

namespace {

Corner operator-(const Corner& a, const Corner& b) { return {a.u - b.u, a.v - b.v}; }
Corner operator*(double s, const Corner& a) { return {s * a.u, s * a.v}; }
double cross(const Corner& a, const Corner& b) { return a.u * b.v - a.v * b.u; }
double dot(const Corner& a, const Corner& b) { return a.u * b.u + a.v * b.v; }

const renderer::Polygon& get_polygon(const Mesh& mesh, std::uint32_t object) {
  return mesh.blockers.polygons[mesh.blockers.objects[object].index()];
}

std::array<Corner, 4> project(const Patch& patch, const renderer::Polygon& on) {
  std::array<Corner, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = {patch.at[k][on.u], patch.at[k][on.v]};
  return corners;
}

struct Box {
  Corner lo{renderer::NO_HIT, renderer::NO_HIT}, hi{-renderer::NO_HIT, -renderer::NO_HIT};
  void add(const Corner& c) {
    lo = {std::min(lo.u, c.u), std::min(lo.v, c.v)};
    hi = {std::max(hi.u, c.u), std::max(hi.v, c.v)};
  }
};

// Indices along u and v of the cell that contains a point in a side's grid, or is nearest to it.
std::array<int, 2> find_cell(const Side& side, const Corner& at) {
  const auto find = [&](double from_lo, double cell) {
    return static_cast<int>(std::clamp(from_lo / cell, 0.0, side.across - 1.0));
  };
  return {find(at.u - side.lo.u, side.cell.u), find(at.v - side.lo.v, side.cell.v)};
}

void make_grid(const Mesh& mesh, Side& side, const renderer::Polygon& polygon) {
  std::vector<Box> boxes(side.patches.size());
  Box all;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (const Corner& corner : project(mesh.patches[side.patches[i]], polygon)) {
      boxes[i].add(corner);
      all.add(corner);
    }
  side.across = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(boxes.size()))));
  side.lo = all.lo;
  side.cell = (1.0 / side.across) * (all.hi - all.lo);
  side.cells.resize(static_cast<std::size_t>(side.across) * static_cast<std::size_t>(side.across));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto lo = find_cell(side, boxes[i].lo), hi = find_cell(side, boxes[i].hi);
    for (int y = lo[1]; y <= hi[1]; ++y)
      for (int x = lo[0]; x <= hi[0]; ++x)
        side.cells[static_cast<std::size_t>(y * side.across + x)].push_back(side.patches[i]);
  }
}

}  // namespace

// Inverts the bilinear map Q = s E + t F + s t G. Elimination of s gives cross(Q - t F, E + t G) =
// a t^2 + b t + c = 0. In a counter-clockwise quad, the quadratic increases at the root inside,
// because the Jacobian of the map is positive there.
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
  Sides sides(2 * object_count(mesh.blockers));
  const auto side_of = [&](std::uint32_t object, const Vec& normal) -> Side& {
    const bool back = dot(normal, get_polygon(mesh, object).normal) < 0;
    return sides[2 * object + (back ? 1 : 0)];
  };
  for (const Mirror& mirror : mesh.mirrors) {
    auto& side = side_of(mirror.object, mirror.normal);
    side.kind = Side::Kind::mirror;
    side.material = mirror.material;
  }
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    auto& side = side_of(mesh.patches[i].object, mesh.patches[i].normal);
    side.kind = Side::Kind::patches;
    side.patches.push_back(i);
  }
  for (std::uint32_t i = 0; i < sides.size(); ++i)
    if (sides[i].kind == Side::Kind::patches) make_grid(mesh, sides[i], get_polygon(mesh, i / 2));
  return sides;
}

Spot locate(const Mesh& mesh, const Side& side, std::uint32_t object, const Vec& point,
            renderer::Work& work) {
  constexpr double SLACK = 1e-9;
  const auto& polygon = get_polygon(mesh, object);
  const Corner at{point[polygon.u], point[polygon.v]};
  const auto [x, y] = find_cell(side, at);
  const auto& near = side.cells[static_cast<std::size_t>(y * side.across + x)];
  Spot best;
  double least = renderer::NO_HIT;  // how far s or t of `best` is outside 0..1
  // (A cell without patches is outside the border of a face that is not a rectangle.)
  for (const auto patch : near.empty() ? side.patches : near) {
    work[renderer::Op::polygon_edges] += 1;
    const auto [s, t] = invert_bilinear(project(mesh.patches[patch], polygon), at);
    const double outside = std::max({0.0, -s, s - 1, -t, t - 1});
    if (!(outside < least)) continue;
    best = {patch, std::clamp(s, 0.0, 1.0), std::clamp(t, 0.0, 1.0)};
    least = outside;
    if (outside <= SLACK) break;
  }
  return best;
}

}  // namespace radiosity

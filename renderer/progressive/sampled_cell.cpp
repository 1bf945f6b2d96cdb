#include "renderer/progressive/sampled_cell.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace renderer::progressive {

namespace {

Point at(const SampledCell& cell, int quarters_right, int quarters_down) {
  return {cell.x + cell.side * quarters_right / 4, cell.y + cell.side * quarters_down / 4};
}

// The colours at the corners of a square (a to d), in its middle (m), and at the middles of its
// upper, left, right and lower sides (n, w, e, s).
struct Square {
  Rgb a, b, c, d, m;
  Rgb n, w, e, s;
};

Rgb mix(const Rgb& p, double weight_p, const Rgb& q, double weight_q, const Rgb& r,
        double weight_r) {
  return weight_p * p + weight_q * q + weight_r * r;
}

// Interpolates the colour at the point (u, v) of the unit square. The square consists of four
// triangles, each between a side and the middle.
Rgb eval_four(const Square& s, double u, double v) {
  if (v <= u && v <= 1 - u) return mix(s.a, 1 - u - v, s.b, u - v, s.m, 2 * v);
  if (v >= u && v >= 1 - u) return mix(s.c, v - u, s.d, u + v - 1, s.m, 2 * (1 - v));
  if (u < v) return mix(s.a, 1 - u - v, s.c, v - u, s.m, 2 * u);
  return mix(s.b, u - v, s.d, u + v - 1, s.m, 2 * (1 - u));
}

// Interpolates the colour over eight triangles, each between half a side and the middle. The
// triangle that contains the point has three corners: `corner` of the square, `half` (the middle of
// a side), and the middle. `along` and `across` are the distances of the point from `corner`, along
// that side and at right angles to it.
Rgb eval_eight(const Square& s, double u, double v) {
  const bool right = u > 0.5, down = v > 0.5;
  const double du = right ? 1 - u : u, dv = down ? 1 - v : v;  // distances from the nearest corner
  const Rgb& corner = down ? (right ? s.d : s.c) : (right ? s.b : s.a);
  const bool by_row = dv <= du;
  const Rgb& half = by_row ? (down ? s.s : s.n) : (right ? s.e : s.w);
  const double along = std::max(du, dv), across = std::min(du, dv);
  return mix(corner, 1 - 2 * along, half, 2 * (along - across), s.m, 2 * across);
}

}  // namespace

int last_level(const SampledCell& cell) { return cell.side > 2 ? 3 : 2; }

Points points_of_level(const SampledCell& cell, int level) {
  switch (level) {
    case 1:
      return {at(cell, 0, 0), at(cell, 4, 0), at(cell, 0, 4), at(cell, 4, 4), at(cell, 2, 2)};
    case 2:
      if (cell.side == 2) return {at(cell, 2, 0), at(cell, 0, 2)};
      return {at(cell, 2, 0), at(cell, 0, 2), at(cell, 4, 2), at(cell, 2, 4)};
    case 3:
      return {at(cell, 1, 1), at(cell, 3, 1), at(cell, 1, 3), at(cell, 3, 3)};
    default:
      throw base::InvariantBroken("a level of sampling from 1 to 3");
  }
}

Points points_of(const SampledCell& cell) {
  Points all;
  for (int level = 1; level <= cell.level; ++level)
    for (const Point& p : points_of_level(cell, level)) all.push_back(p);
  return all;
}

bool owns(const SampledCell& cell, const Point& p) {
  return p.x >= cell.x && p.y >= cell.y && p.x < cell.x + cell.side && p.y < cell.y + cell.side;
}

std::array<SampledCell, 4> divide(const SampledCell& cell) {
  const int half = cell.side / 2;
  const auto daughter = [&](int right, int down) {
    return SampledCell{cell.x + right * half, cell.y + down * half, half, 1};
  };
  return {daughter(0, 0), daughter(1, 0), daughter(0, 1), daughter(1, 1)};
}

std::vector<Triangle> triangles_of(const SampledCell& cell) {
  std::vector<Triangle> all;
  // Adds a triangle between `middle` and each pair of consecutive points around it. The last point
  // must equal the first.
  const auto add_fan = [&](const Point& middle, std::initializer_list<Point> around) {
    for (const Point* p = around.begin(); p + 1 != around.end(); ++p)
      all.push_back({p[0], p[1], middle});
  };
  const auto square = [&](int x, int y, int size) {
    add_fan(at(cell, x + size / 2, y + size / 2),
            {at(cell, x, y), at(cell, x + size, y), at(cell, x + size, y + size),
             at(cell, x, y + size), at(cell, x, y)});
  };
  if (cell.level == 1) square(0, 0, 4);
  if (cell.level == 2)
    add_fan(at(cell, 2, 2),
            {at(cell, 0, 0), at(cell, 2, 0), at(cell, 4, 0), at(cell, 4, 2), at(cell, 4, 4),
             at(cell, 2, 4), at(cell, 0, 4), at(cell, 0, 2), at(cell, 0, 0)});
  if (cell.level == 3)
    for (const int y : {0, 2})
      for (const int x : {0, 2}) square(x, y, 2);
  return all;
}

namespace {

// Interpolates the unsampled pixels of a cell.
class Interpolation {
 public:
  Interpolation(const SampledCell& cell, std::span<const Rgb> colours)
      : level_(cell.level), colours_(colours), whole_{colours[0], colours[1], colours[2],
                                                      colours[3], colours[4], {},
                                                      {},         {},         {}} {
    if (level_ < 2 || colours.size() < 9) return;
    whole_.n = colours[5];
    whole_.w = colours[6];
    whole_.e = colours[7];
    whole_.s = colours[8];
  }

  // The colour at the point (u, v) of the cell; u and v are from 0 to 1.
  Rgb eval(double u, double v) const {
    if (level_ == 1) return eval_four(whole_, u, v);
    if (level_ == 2) return eval_eight(whole_, u, v);
    const bool right = u > 0.5, down = v > 0.5;
    return eval_four(quadrant(right, down), 2 * u - right, 2 * v - down);
  }

 private:
  Square quadrant(bool right, bool down) const {
    const auto& [a, b, c, d, m, n, w, e, s] = whole_;
    const Rgb& middle = colours_[9u + 2u * down + right];
    if (down)
      return right ? Square{m, e, s, d, middle, {}, {}, {}, {}}
                   : Square{w, m, c, s, middle, {}, {}, {}, {}};
    return right ? Square{n, b, m, e, middle, {}, {}, {}, {}}
                 : Square{a, n, w, m, middle, {}, {}, {}, {}};
  }

  int level_;
  std::span<const Rgb> colours_;
  Square whole_;
};

}  // namespace

Painting paint(const SampledCell& cell, const Area& image, std::span<const Rgb> colours,
               Work& work) {
  const int left = std::max(cell.x, image.x), top = std::max(cell.y, image.y);
  const int right = std::min(cell.x + cell.side, image.x + image.width);
  const int bottom = std::min(cell.y + cell.side, image.y + image.height);
  Painting painting{{left, top, std::max(0, right - left), std::max(0, bottom - top)}, {}};
  const auto points = points_of(cell);
  const Interpolation interpolation(cell, colours);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const auto sampled = std::ranges::find(points, Point{x, y});
      Rgb colour;
      if (sampled != points.end()) {
        colour = colours[static_cast<std::size_t>(sampled - points.begin())];
      } else {
        work[Op::pixel_interpolated] += 1;
        colour = interpolation.eval(static_cast<double>(x - cell.x) / cell.side,
                                    static_cast<double>(y - cell.y) / cell.side);
      }
      work[Op::pixel_drawn] += 1;
      for (const auto byte : make_rgb8(colour)) painting.rgb8.push_back(byte);
    }
  return painting;
}

}  // namespace renderer::progressive

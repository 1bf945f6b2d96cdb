#include "renderer/scene/texture.hpp"

#include <numbers>

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr double MOST_TEXEL = 65535;
constexpr std::uint16_t TEXEL_OF_BYTE = 257;

std::size_t area_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// Calls `add(texel, overlap)` for each texel of a level that is covered by texel `index` of the
// next, coarser level, in one direction. The levels have `length` and `next` texels in this
// direction; `next` is also the overlap of a whole texel. (If `length` is odd, three texels are
// covered, two of them partly.)
template <class Add>
void for_each_covered(int index, int length, int next, const Add& add) {
  const std::int64_t from = std::int64_t{index} * length, to = from + length;
  for (std::int64_t i = from / next; i * next < to; ++i)
    add(static_cast<int>(i), std::min(to, (i + 1) * next) - std::max(from, i * next));
}

Texel eval_mean(const Level& level, const Level& next, int x, int y) {
  std::int64_t r = 0, g = 0, b = 0;
  for_each_covered(y, level.height, next.height, [&](int row, std::int64_t high) {
    for_each_covered(x, level.width, next.width, [&](int column, std::int64_t wide) {
      const Texel& texel =
          level.texels[area_of(level.width, row) + static_cast<std::size_t>(column)];
      r += high * wide * texel.r;
      g += high * wide * texel.g;
      b += high * wide * texel.b;
    });
  });
  const std::int64_t whole = std::int64_t{level.width} * level.height;
  const auto divide = [&](std::int64_t sum) {
    return static_cast<std::uint16_t>((sum + whole / 2) / whole);
  };
  return {divide(r), divide(g), divide(b)};
}

Level make_next(const Level& level) {
  Level next{std::max(1, level.width / 2), std::max(1, level.height / 2), {}};
  next.texels.reserve(area_of(next.width, next.height));
  for (int y = 0; y < next.height; ++y)
    for (int x = 0; x < next.width; ++x) next.texels.push_back(eval_mean(level, next, x, y));
  return next;
}

// Two neighbouring texels in a row of `length` texels, and the weight of the second one.
struct Neighbours {
  int first = 0, second = 0;
  double share = 0;
};
Neighbours find_neighbours(double coordinate, int length, Beyond beyond) {
  double part = beyond == Beyond::stays ? std::clamp(coordinate, 0.0, 1.0)
                                        : coordinate - std::floor(coordinate);
  if (!(part >= 0)) part = 0;  // coordinates that are not finite become 0
  const double at = part * length - 0.5, floor = std::floor(at);
  const int first = static_cast<int>(floor);
  if (beyond == Beyond::stays)
    return {std::max(first, 0), std::min(first + 1, length - 1), at - floor};
  return {(first + length) % length, (first + 1) % length, at - floor};
}

// Arc tangent for 0 <= x <= 1: halves the angle twice, then sums a series.
double eval_arc_tangent(double x) {
  for (int i = 0; i < 2; ++i) x /= 1 + std::sqrt(1 + x * x);
  const double square = x * x;
  double sum = 0;
  for (int n = 23; n > 0; n -= 2) sum = 1.0 / n - square * sum;
  return 4 * x * sum;
}

TexturePoint eval_spherical(const Mapping& m, const Vec& point) {
  const Vec from_middle = point - m.origin;
  const double x = dot(from_middle, m.u), y = dot(from_middle, m.v), z = dot(from_middle, m.axis);
  const double square = x * x + y * y, across = std::sqrt(square);
  TexturePoint found;
  found.beyond = Beyond::stays;
  found.u = eval_turn(y, x);
  // Maps latitudes from the south pole (a quarter turn below the equator) to the north pole to
  // 0..1.
  const double latitude = eval_turn(z, across);
  found.v = 0.5 + 2 * (latitude > 0.5 ? latitude - 1 : latitude);
  if (!(square > 0)) return found;
  constexpr double HALF_TURN = std::numbers::pi;
  found.grow_u = (1 / (2 * HALF_TURN * square)) * (x * m.v - y * m.u);
  found.grow_v =
      (1 / (HALF_TURN * (square + z * z))) * (across * m.axis - (z / across) * (x * m.u + y * m.v));
  return found;
}

}  // namespace

Pyramid make_pyramid(int width, int height, std::span<const std::uint8_t> rgb8) {
  require(width >= 1 && height >= 1 && rgb8.size() == 3 * area_of(width, height), "a texture",
          fmt::format("{} bytes for {} x {} pixels", rgb8.size(), width, height), "3 for each");
  Level first{width, height, {}};
  first.texels.reserve(area_of(width, height));
  const auto to_texel = [](std::uint8_t byte) {
    return static_cast<std::uint16_t>(byte * TEXEL_OF_BYTE);
  };
  for (std::size_t i = 0; i < rgb8.size(); i += 3)
    first.texels.push_back({to_texel(rgb8[i]), to_texel(rgb8[i + 1]), to_texel(rgb8[i + 2])});
  Pyramid pyramid{{std::move(first)}};
  while (pyramid.levels.back().texels.size() > 1)
    pyramid.levels.push_back(make_next(pyramid.levels.back()));
  return pyramid;
}

std::uint64_t texel_count(const Pyramid& pyramid) {
  std::uint64_t count = 0;
  for (const Level& level : pyramid.levels) count += level.texels.size();
  return count;
}

Rgb eval_bilinear(const Level& level, double u, double v, Beyond beyond) {
  const auto across = find_neighbours(u, level.width, Beyond::repeats);
  const auto down = find_neighbours(beyond == Beyond::stays ? 1 - v : -v, level.height, beyond);
  const auto get = [&](int x, int y) {
    const Texel& t = level.texels[area_of(level.width, y) + static_cast<std::size_t>(x)];
    return Rgb{t.r / MOST_TEXEL, t.g / MOST_TEXEL, t.b / MOST_TEXEL};
  };
  const auto get_row = [&](int y) {
    return (1 - across.share) * get(across.first, y) + across.share * get(across.second, y);
  };
  return (1 - down.share) * get_row(down.first) + down.share * get_row(down.second);
}

Filtered eval_filtered(const Pyramid& pyramid, double u, double v, double size, Beyond beyond) {
  constexpr int READ = 4;  // number of texels read in one level
  const auto get = [&](std::size_t level) {
    return eval_bilinear(pyramid.levels[level], u, v, beyond);
  };
  if (size <= 1) return {get(0), READ};
  const std::size_t last = pyramid.levels.size() - 1;
  const auto level = static_cast<std::size_t>(std::ilogb(std::min(0x1p30, size)));
  if (level >= last) return {get(last), READ};
  // The weight of the next level grows linearly, from 0 at size 2^level to 1 at size 2^(level + 1).
  const double share = std::ldexp(size, -static_cast<int>(level)) - 1;
  return {(1 - share) * get(level) + share * get(level + 1), 2 * READ};
}

Mapping make_planar(const Vec& origin, const Vec& along_u, const Vec& along_v) {
  // Dual basis: u grows by 1 along `along_u`, and is constant along `along_v` and along the normal.
  const Vec normal = cross(along_u, along_v);
  const double square = dot(normal, normal);
  const double u_square = dot(along_u, along_u), v_square = dot(along_v, along_v);
  // smallest square of a length, and smallest square of the sine
  constexpr double LEAST = 1e-40, LEAST_SINE = 1e-18;
  require(u_square >= LEAST && v_square >= LEAST && square > LEAST_SINE * u_square * v_square,
          "a planar texture whose edges span no plane", "two edges of different directions");
  return {Mapping::Kind::planar,
          origin,
          (1 / square) * cross(along_v, normal),
          (1 / square) * cross(normal, along_u),
          {}};
}

Mapping make_spherical(const Vec& middle, const Vec& axis) {
  require(length(axis) > 0, "an axis of length 0", "a direction");
  const Vec north = normalize(axis);
  const bool is_along_x = std::abs(north.x) > 0.9;
  const Vec towards = is_along_x ? Vec{0, 1, 0} : Vec{1, 0, 0};
  const Vec zero = normalize(towards - dot(towards, north) * north);
  return {Mapping::Kind::spherical, middle, zero, cross(north, zero), north};
}

TexturePoint eval_mapping(const Mapping& m, const Vec& point) {
  if (m.kind == Mapping::Kind::spherical) return eval_spherical(m, point);
  const Vec from_origin = point - m.origin;
  return {dot(from_origin, m.u), dot(from_origin, m.v), m.u, m.v};
}

double eval_turn(double y, double x) {
  const double wide = std::abs(x), high = std::abs(y);
  if (wide == 0 && high == 0) return 0;
  constexpr double TURN = 2 * std::numbers::pi;
  // Computes the angle in the first quadrant, then reflects it into the quadrant of the vector.
  double turn = high <= wide ? eval_arc_tangent(high / wide) / TURN
                             : 0.25 - eval_arc_tangent(wide / high) / TURN;
  if (x < 0) turn = 0.5 - turn;
  if (y < 0) turn = 1 - turn;
  return turn < 1 ? turn : 0;
}

}  // namespace renderer

#include "renderer/trace/sampling.hpp"

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace renderer {

namespace {

std::uint64_t mix(std::uint64_t a, std::uint64_t b) { return base::random_at(a, b); }

double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// The stream of one pixel's numbers for one purpose.
std::uint64_t make_stream(const Sampling& s, const SampleKey& key, Dimension dimension) {
  return mix(mix(s.seed, key.pixel), std::uint64_t{key.path} << 8 | std::uint64_t(dimension));
}

// Which of the round's regions the sample lies in.
int find_region(std::uint64_t stream, const Round& round, int pass) {
  const auto key =
      static_cast<std::uint32_t>(mix(stream, ~static_cast<std::uint64_t>(round.first)));
  return permute(pass - round.first, round.count, key);
}

// Samples of which nobody knows how many there will be: the square is divided into 4 regions, each
// of these into 4 and so on, and wherever the samples end at 4^k, each region of that size has one;
// at 2 * 4^k two that touch at their corners. Returns the digits of the sample's place to base 4,
// from the largest region to the smallest, of which there are 4^levels.
int find_nested(std::uint64_t stream, int index, int levels) {
  std::uint64_t larger = 1;  // the regions around it
  int place = 0;
  for (int level = 0; level < levels; ++level, index /= 4) {
    // In each region another order: a corner, the one across, the other two.
    const std::uint64_t bits = mix(stream, ~larger);
    const int first = static_cast<int>(bits & 3), side = (bits & 4) != 0 ? 1 : 2;
    const int order[] = {first, first ^ 3, first ^ side, first ^ side ^ 3};
    const int digit = index % 4;
    place = 4 * place + order[digit];
    larger = 4 * larger + static_cast<std::uint64_t>(digit);
  }
  return place;
}

int count_levels(int samples) {
  int levels = 0;
  while (1 << (2 * levels) < samples) ++levels;
  return levels;
}

// A sample's place among those of a dimension. In the pixel they come as they are,
// so that samples i and i + 4^k share a region; other dimensions are paired with it at random
// within each round.
struct NestedPlace {
  int place = 0, levels = 0;
};
NestedPlace find_nested(const Sampling& s, const SampleKey& key, Dimension dimension,
                        std::uint64_t stream) {
  const Round round = round_of(s, key.pass);
  const int index =
      dimension == Dimension::pixel ? key.pass : round.first + find_region(stream, round, key.pass);
  const int levels = count_levels(s.pixel_samples);
  return {find_nested(stream, index, levels), levels};
}

Region make_nested_region(const NestedPlace& nested) {
  int column = 0, row = 0;
  for (int level = nested.levels - 1; level >= 0; --level) {
    const int digit = nested.place >> (2 * level);
    column = 2 * column + (digit & 1);
    row = 2 * row + (digit >> 1 & 1);
  }
  const double side = 1.0 / (1 << nested.levels);
  return {column * side, row * side, side, side};
}

// sin() and cos() for angles of at most pi / 4, by their series.
double eval_sine(double x) {
  const double square = x * x;
  double sum = 0;
  for (int n = 17; n > 1; n -= 2) sum = (sum + 1) * -square / (n * (n - 1));
  return x * (1 + sum);
}
double eval_cosine(double x) {
  const double square = x * x;
  double sum = 0;
  for (int n = 18; n > 0; n -= 2) sum = (sum + 1) * -square / (n * (n - 1));
  return 1 + sum;
}

}  // namespace

Round round_of(const Sampling& s, int pass) {
  if (!is_adaptive(s)) return {0, s.pixel_samples};
  int first = 0, end = FIRST_ROUND;
  while (pass >= end) {
    first = end;
    end *= end == 4 ? 4 : 2;
  }
  return {first, std::min(end, s.pixel_samples) - first};
}

Region make_region(int index, int count) {
  const int rows = static_cast<int>(std::lround(std::sqrt(count)));
  const auto first_of = [&](int row) {
    return static_cast<int>(static_cast<std::int64_t>(row) * count / rows);
  };
  const int row = static_cast<int>(((index + std::int64_t{1}) * rows - 1) / count);
  const int first = first_of(row), columns = first_of(row + 1) - first;
  return {static_cast<double>(index - first) / columns, static_cast<double>(first) / count,
          1.0 / columns, static_cast<double>(columns) / count};
}

int permute(int index, int count, std::uint32_t key) {
  const auto length = static_cast<std::uint32_t>(count);
  std::uint32_t mask = length - 1;
  for (int shift = 1; shift < 32; shift *= 2) mask |= mask >> shift;
  auto i = static_cast<std::uint32_t>(index);
  do {
    i ^= key;
    i *= 0xe170893du;
    i ^= key >> 16;
    i ^= (i & mask) >> 4;
    i ^= key >> 8;
    i *= 0x0929eb3fu;
    i ^= key >> 23;
    i ^= (i & mask) >> 1;
    i *= 1 | key >> 27;
    i *= 0x6935fa69u;
    i ^= (i & mask) >> 11;
    i *= 0x74dcb303u;
    i ^= (i & mask) >> 2;
    i *= 0x9e501cc3u;
    i ^= (i & mask) >> 2;
    i *= 0xc860a3dfu;
    i &= mask;
    i ^= i >> 5;
  } while (i >= length);
  return static_cast<int>((static_cast<std::uint64_t>(i) + key) % length);
}

SquarePoint sample_square(const Sampling& s, const SampleKey& key, Dimension dimension) {
  const Round round = round_of(s, key.pass);
  const auto stream = make_stream(s, key, dimension);
  const Region in = is_adaptive(s) ? make_nested_region(find_nested(s, key, dimension, stream))
                                   : make_region(find_region(stream, round, key.pass), round.count);
  const auto pass = static_cast<std::uint64_t>(key.pass);
  return {in.u + in.width * to_unit(mix(stream, 2 * pass)),
          in.v + in.height * to_unit(mix(stream, 2 * pass + 1))};
}

double sample_line(const Sampling& s, const SampleKey& key, Dimension dimension) {
  const Round round = round_of(s, key.pass);
  const auto stream = make_stream(s, key, dimension);
  const double jitter = to_unit(mix(stream, 2 * static_cast<std::uint64_t>(key.pass)));
  if (is_adaptive(s)) {
    const auto [place, levels] = find_nested(s, key, dimension, stream);
    return (place + jitter) / (1 << (2 * levels));
  }
  return (find_region(stream, round, key.pass) + jitter) / round.count;
}

SquarePoint map_to_disc(const SquarePoint& at) {
  const double a = 2 * at.u - 1, b = 2 * at.v - 1;
  if (a == 0 && b == 0) return {};
  constexpr double EIGHTH = std::numbers::pi / 4;
  const auto angle = [&](double share) { return EIGHTH * share; };
  if (std::abs(a) > std::abs(b))
    return {a * eval_cosine(angle(b / a)), a * eval_sine(angle(b / a))};
  return {b * eval_sine(angle(a / b)), b * eval_cosine(angle(a / b))};
}

// T. Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
Across make_across(const Vec& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

}  // namespace renderer

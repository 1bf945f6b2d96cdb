#include "renderer/trace/sampling.hpp"

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace renderer {

namespace {

std::uint64_t mix(std::uint64_t a, std::uint64_t b) { return base::random_at(a, b); }

double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// The seed of the random numbers of one pixel for one purpose.
std::uint64_t make_stream(const Sampling& s, const SampleKey& key, Dimension dimension) {
  return mix(mix(s.seed, key.pixel), std::uint64_t{key.path} << 8 | std::uint64_t(dimension));
}

// Index of the sample's region among the regions of its round.
int find_region(std::uint64_t stream, const Round& round, int pass) {
  const auto key =
      static_cast<std::uint32_t>(mix(stream, ~static_cast<std::uint64_t>(round.first)));
  return permute(pass - round.first, round.count, key);
}

std::uint32_t reverse(std::uint32_t x) {
  x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
  x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
  return x << 16 | x >> 16;
}

// Flips each bit at random, depending only on the more significant bits (A. Owen, 1995). Points in
// a common half, quarter and so on of the line stay together.
std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse(x) + seed;
  for (const std::uint32_t factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u})
    x ^= x * factor;
  return reverse(x);
}

// In an adaptive pixel, the index of a sample in the sequence of its group. For Dimension::pixel,
// indices are in the order of the samples. For other dimensions, each round pairs samples and
// indices at random.
int find_index(const Sampling& s, const SampleKey& key, Dimension dimension, std::uint64_t stream) {
  const int place = key.pass / GROUPS;
  if (dimension == Dimension::pixel) return place;
  const Round round = round_of(s, key.pass);
  const int first = round.first / GROUPS;
  const int end = (round.first + round.count - group_of(key.pass) + GROUPS - 1) / GROUPS;
  return first + find_region(stream, {first, end - first}, place);
}

SquarePoint sample_group(const Sampling& s, const SampleKey& key, Dimension dimension,
                         std::uint64_t stream) {
  const auto group = static_cast<std::uint64_t>(group_of(key.pass));
  const std::uint64_t own = mix(stream, group), seeds = mix(own, 0);
  const int index = find_index(s, key, dimension, own);
  const auto [u, v] = eval_sequence(static_cast<std::uint32_t>(index));
  const SquarePoint at{0x1p-32 * scramble(u, static_cast<std::uint32_t>(seeds)),
                       0x1p-32 * scramble(v, static_cast<std::uint32_t>(seeds >> 32))};
  if (dimension != Dimension::pixel) return at;
  const std::uint64_t quarter = group ^ (mix(stream, GROUPS) & 3);
  return {(static_cast<double>(quarter & 1) + at.u) / 2,
          (static_cast<double>(quarter >> 1) + at.v) / 2};
}

// Series for sin() and cos(), valid for angles up to pi / 4.
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
    end *= 2;
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

WholePoint eval_sequence(std::uint32_t index) {
  WholePoint point{reverse(index), 0};
  for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1)
    if ((index & 1) != 0) point.v ^= direction;
  return point;
}

WholePoint eval_pixel_sequence(int pass) {
  const auto group = static_cast<std::uint32_t>(group_of(pass));
  const auto [u, v] = eval_sequence(static_cast<std::uint32_t>(pass / GROUPS));
  return {(group & 1) << 31 | u >> 1, (group >> 1) << 31 | v >> 1};
}

SquarePoint sample_square(const Sampling& s, const SampleKey& key, Dimension dimension) {
  const auto stream = make_stream(s, key, dimension);
  if (is_adaptive(s)) return sample_group(s, key, dimension, stream);
  const Round round = round_of(s, key.pass);
  const Region in = make_region(find_region(stream, round, key.pass), round.count);
  const auto pass = static_cast<std::uint64_t>(key.pass);
  return {in.u + in.width * to_unit(mix(stream, 2 * pass)),
          in.v + in.height * to_unit(mix(stream, 2 * pass + 1))};
}

double sample_line(const Sampling& s, const SampleKey& key, Dimension dimension) {
  if (is_adaptive(s)) return sample_square(s, key, dimension).u;
  const Round round = round_of(s, key.pass);
  const auto stream = make_stream(s, key, dimension);
  const double jitter = to_unit(mix(stream, 2 * static_cast<std::uint64_t>(key.pass)));
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

// Implements the method of T. Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
Across make_across(const Vec& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

}  // namespace renderer

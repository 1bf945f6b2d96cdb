#pragma once
// Where the samples of a pixel lie (R. Cook, T. Porter and L. Carpenter, 1984): the pixel, the
// lens, the time and every light and surface that spreads rays are divided into as many regions as
// there are samples; a sample has one region of each, paired at random, and a random place in it.
//
// Numbers depend on nothing but the seed, the pixel, the sample, what they are for, and the ray's
// path in its shading tree: samples may be taken in any order, anywhere.

#include "renderer/trace/params.hpp"

namespace renderer {

/// A point of the unit square, 0 <= u, v < 1.
struct SquarePoint {
  double u = 0, v = 0;
};

/// What a random number is for.
enum class Dimension : std::uint32_t { pixel, lens, time, light, gloss, translucency };

/// Which sample: pixel y * width + x, its sample `pass`, and the path of a ray.
struct SampleKey {
  std::uint32_t pixel = 0;
  int pass = 0;
  std::uint32_t path = 1;
};

/// Samples that are spread over as many regions as they are.
struct Round {
  int first = 0, count = 1;
};
inline constexpr int FIRST_ROUND = 16;
/// Whether pixels may have different numbers of samples: not unless there is more than one round.
inline bool is_adaptive(const Sampling& s) {
  return s.adaptive > 0 && s.pixel_samples > FIRST_ROUND;
}
/// All of a pixel's samples are one round; with adaptive sampling, rounds end at 16, 32, 64 ...
/// samples, the last one at `pixel_samples`.
Round round_of(const Sampling& sampling, int pass);
/// How many samples a pixel has after its first round.
inline int first_round(const Sampling& sampling) { return round_of(sampling, 0).count; }

/// A point of the unit square in units of 2^-32.
struct WholePoint {
  std::uint32_t u = 0, v = 0;
};
/// Points of I. Sobol's sequence (1967): of the first 2^n one lies in each rectangle of that area
/// whose sides are halves, quarters ... of the square's.
WholePoint eval_sequence(std::uint32_t index);

/// With adaptive sampling, the samples of a pixel form groups. Each group lies in a quarter of the
/// pixel. Which quarter that is, is random; all other random numbers of different groups are
/// independent, as find_kept() needs.
inline constexpr int GROUPS = 4;
inline int group_of(int pass) { return pass % GROUPS; }
/// Samples of an adaptive pixel share a square of its division into halves, quarters ... exactly if
/// these points do.
WholePoint eval_pixel_sequence(int pass);

/// The sample's point of a square: one of the samples lies in each of `count` regions of equal
/// area, in rows as equal as can be. With adaptive sampling, each group has a scrambled
/// eval_sequence() of its own: samples that share one of the sequence's rectangles still do.
SquarePoint sample_square(const Sampling& sampling, const SampleKey& key, Dimension dimension);
/// The sample's point of a line, 0..1.
double sample_line(const Sampling& sampling, const SampleKey& key, Dimension dimension);

/// Region `index` of `count`, as its corner and its sides.
struct Region {
  double u = 0, v = 0, width = 1, height = 1;
};
Region make_region(int index, int count);
/// Element `index` of a random order of `count` things, 1 or more (A. Kensler, "Correlated
/// Multi-Jittered Sampling", 2013).
int permute(int index, int count, std::uint32_t key);

/// The square onto the disc of radius 1, areas in proportion (P. Shirley and K. Chiu, 1997). The
/// same bits on any machine: no function of the mathematics library.
SquarePoint map_to_disc(const SquarePoint& at);

/// Two unit vectors that are across `axis` (unit) and each other.
struct Across {
  Vec u, v;
};
Across make_across(const Vec& axis);

/// What a contribution to the image's sums is multiplied with: 1 / N, or 1 where a pixel's number
/// of samples is not known before.
inline double weight_of(const Sampling& s) { return is_adaptive(s) ? 1.0 : 1.0 / s.pixel_samples; }

}  // namespace renderer

#pragma once
// Stratified sampling of a pixel (R. Cook, T. Porter and L. Carpenter, 1984). The pixel, the lens,
// the time and every light and surface that spreads rays are divided into as many regions as
// samples. A sample has a random point in one region of each, paired at random.
//
// Random numbers depend only on the seed, the pixel, the sample, the dimension, and the ray's path
// in its shading tree: samples may be taken in any order, anywhere.

#include "renderer/trace/params.hpp"

namespace renderer {

/// A point of the unit square, 0 <= u, v < 1.
struct SquarePoint {
  double u = 0, v = 0;
};

/// Purpose of a random number.
enum class Dimension : std::uint32_t { pixel, lens, time, light, gloss, translucency };

/// Identifies a sample: pixel y * width + x, its sample `pass`, and the path of a ray.
struct SampleKey {
  std::uint32_t pixel = 0;
  int pass = 0;
  std::uint32_t path = 1;
};

/// Samples that are stratified together, over as many regions.
struct Round {
  int first = 0, count = 1;
};
inline constexpr int FIRST_ROUND = 16;
/// True if pixels may have different numbers of samples, which needs more than one round.
inline bool is_adaptive(const Sampling& s) {
  return s.adaptive > 0 && s.pixel_samples > FIRST_ROUND;
}
/// All of a pixel's samples are one round. With adaptive sampling, rounds end at 16, 32, 64 ...
/// samples, the last one at `pixel_samples`.
Round round_of(const Sampling& sampling, int pass);
/// Number of samples after a pixel's first round.
inline int first_round(const Sampling& sampling) { return round_of(sampling, 0).count; }

/// A point of the unit square in units of 2^-32.
struct WholePoint {
  std::uint32_t u = 0, v = 0;
};
/// Points of I. Sobol's sequence (1967): of the first 2^n, one lies in each rectangle of area 2^-n
/// with sides that are halves, quarters ... of the square's.
WholePoint eval_sequence(std::uint32_t index);

/// With adaptive sampling, the samples of a pixel form groups. Each group lies in a random quarter
/// of the pixel; all other random numbers of different groups are independent, as find_kept()
/// needs.
inline constexpr int GROUPS = 4;
inline int group_of(int pass) { return pass % GROUPS; }
/// Samples of an adaptive pixel share a square of its division into halves, quarters ... exactly if
/// these points do.
WholePoint eval_pixel_sequence(int pass);

/// The sample's point of a square. Each of `count` regions of equal area, in nearly equal rows,
/// holds one sample. With adaptive sampling, each group has its own scrambled eval_sequence(),
/// which keeps samples in their rectangles of the sequence together.
SquarePoint sample_square(const Sampling& sampling, const SampleKey& key, Dimension dimension);
/// The sample's point of a line, 0..1.
double sample_line(const Sampling& sampling, const SampleKey& key, Dimension dimension);

/// Corner and sides of region `index` of `count`.
struct Region {
  double u = 0, v = 0, width = 1, height = 1;
};
Region make_region(int index, int count);
/// Element `index` of a random permutation of `count` elements, 1 or more (A. Kensler, "Correlated
/// Multi-Jittered Sampling", 2013).
int permute(int index, int count, std::uint32_t key);

/// Area-preserving map from the square to the unit disc (P. Shirley and K. Chiu, 1997). Without
/// functions of the maths library, so that all machines get the same bits.
SquarePoint map_to_disc(const SquarePoint& at);

/// Two unit vectors across `axis` (unit) and each other.
struct Across {
  Vec u, v;
};
Across make_across(const Vec& axis);

/// Weight of a contribution in the image's sums: 1 / N, or 1 if a pixel's number of samples is not
/// known beforehand.
inline double weight_of(const Sampling& s) { return is_adaptive(s) ? 1.0 : 1.0 / s.pixel_samples; }

}  // namespace renderer

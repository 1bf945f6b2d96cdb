#pragma once
// Stratified sampling of a pixel (R. Cook, T. Porter and L. Carpenter, 1984). The pixel, the lens,
// the time, and every light and surface that spreads rays are divided into as many regions as there
// are samples. Each sample takes a random point in one region of each of these; regions are paired
// at random.
//
// Random numbers depend only on the seed, the pixel, the sample, the dimension, and the ray's path
// in its shading tree. Samples may therefore be taken in any order, on any processor.

#include "renderer/trace/params.hpp"

namespace renderer {

/// A point of the unit square, 0 <= u, v < 1.
struct SquarePoint {
  double u = 0, v = 0;
};

/// Purpose of a random number.
enum class Dimension : std::uint32_t { pixel, lens, time, light, gloss, translucency };

/// Key of a sample: pixel y * width + x, its sample `pass`, and the path of a ray.
struct SampleKey {
  std::uint32_t pixel = 0;
  int pass = 0;
  std::uint32_t path = 1;
};

/// Samples that are stratified together: `count` samples in as many regions.
struct Round {
  int first = 0, count = 1;
};
inline constexpr int FIRST_ROUND = 16;
/// True if pixels may have different numbers of samples, which needs more than one round.
inline bool is_adaptive(const Sampling& s) {
  return s.adaptive > 0 && s.pixel_samples > FIRST_ROUND;
}
/// The round of a sample. Without adaptive sampling, all samples of a pixel are one round. With it,
/// rounds end at 16, 32, 64 ... samples, the last one at `pixel_samples`.
Round round_of(const Sampling& sampling, int pass);
/// Number of samples after a pixel's first round.
inline int first_round(const Sampling& sampling) { return round_of(sampling, 0).count; }

/// A point of the unit square in units of 2^-32.
struct WholePoint {
  std::uint32_t u = 0, v = 0;
};
/// Points of I. Sobol's sequence (1967). Of the first 2^n, one lies in each rectangle of area 2^-n
/// whose sides are halves, quarters ... of those of the square.
WholePoint eval_sequence(std::uint32_t index);

/// Number of groups of a pixel's samples with adaptive sampling. Each group lies in a random
/// quarter of the pixel. All other random numbers of different groups are independent, as
/// find_kept() requires.
inline constexpr int GROUPS = 4;
inline int group_of(int pass) { return pass % GROUPS; }
/// The point that determines a sample's square in an adaptive pixel. When the pixel is divided into
/// halves, quarters ..., samples share a square if and only if these points do.
WholePoint eval_pixel_sequence(int pass);

/// The point of a sample in the unit square. Each of `count` regions of equal area, in nearly equal
/// rows, holds one sample. With adaptive sampling, each group has its own scrambled
/// eval_sequence(). Samples that share a rectangle of the sequence still share one after
/// scrambling.
SquarePoint sample_square(const Sampling& sampling, const SampleKey& key, Dimension dimension);
/// The point of a sample on a line, 0..1.
double sample_line(const Sampling& sampling, const SampleKey& key, Dimension dimension);

/// Corner and sides of region `index` of `count`.
struct Region {
  double u = 0, v = 0, width = 1, height = 1;
};
Region make_region(int index, int count);
/// Element `index` of a random permutation of `count` elements, 1 or more (A. Kensler, "Correlated
/// Multi-Jittered Sampling", 2013).
int permute(int index, int count, std::uint32_t key);

/// Area-preserving map from the square to the unit disc (P. Shirley and K. Chiu, 1997). Uses no
/// functions of the maths library, so that all hosts get the same bits.
SquarePoint map_to_disc(const SquarePoint& at);

/// Two unit vectors that form an orthonormal basis with the unit vector `axis`.
struct Across {
  Vec u, v;
};
Across make_across(const Vec& axis);

/// Weight of a contribution in the image's sums: 1 / N, or 1 if the number of samples is not known
/// in advance.
inline double weight_of(const Sampling& s) { return is_adaptive(s) ? 1.0 : 1.0 / s.pixel_samples; }

}  // namespace renderer

#pragma once
// Stratified sampling of a pixel (R. Cook, T. Porter and L. Carpenter, 1984). The pixel, the lens,
// the time, and every light and surface that spreads rays are each divided into as many regions as
// there are samples. A sample takes a random point in one region of each of them. Regions are
// paired at random.
//
// Random numbers depend only on the seed, the pixel, the sample, the dimension, and the ray's path
// in its shading tree. Samples may therefore be taken in any order, on any processor.

#include "renderer/trace/params.hpp"

namespace renderer {

/// A point of the unit square, 0 <= u, v < 1.
struct SquarePoint {
  double u = 0, v = 0;
};

/// The purpose of a random number.
enum class Dimension : std::uint32_t { pixel, lens, time, light, gloss, translucency };

/// Identifies a random point: the pixel as y * width + x, the number `pass` of the sample in it,
/// and the ray's path in the shading tree.
struct SampleKey {
  std::uint32_t pixel = 0;
  int pass = 0;
  std::uint32_t path = 1;
};

/// A round: `count` samples that are stratified together, in as many regions.
struct Round {
  int first = 0, count = 1;
};
inline constexpr int FIRST_ROUND = 16;
/// True if pixels may have different numbers of samples, which requires more than one round.
inline bool is_adaptive(const Sampling& s) {
  return s.adaptive > 0 && s.pixel_samples > FIRST_ROUND;
}
/// The round of a sample. Without adaptive sampling, all samples of a pixel are one round. With
/// adaptive sampling, rounds end at 16, 32, 64 ... samples; the last round ends at `pixel_samples`.
Round round_of(const Sampling& sampling, int pass);
/// Number of samples in a pixel's first round.
inline int first_round(const Sampling& sampling) { return round_of(sampling, 0).count; }

/// A point of the unit square, in units of 2^-32.
struct WholePoint {
  std::uint32_t u = 0, v = 0;
};
/// Points of I. Sobol's sequence (1967). Of its first 2^n points, exactly one lies in each
/// rectangle of area 2^-n that results from repeated halving of the unit square.
WholePoint eval_sequence(std::uint32_t index);

/// Number of groups of a pixel's samples in adaptive sampling. The samples of each group lie in a
/// random quarter of the pixel. All other random numbers of different groups are independent, as
/// find_kept() requires.
inline constexpr int GROUPS = 4;
inline int group_of(int pass) { return pass % GROUPS; }
/// A point that determines where in an adaptive pixel a sample lies. If the pixel is divided into
/// halves, quarters and so on, samples are in one square if and only if their points are.
WholePoint eval_pixel_sequence(int pass);

/// The point of a sample in the unit square. There are `count` regions of equal area, in nearly
/// equal rows, and each one holds one sample. With adaptive sampling, each group has its own
/// scrambled eval_sequence(); samples in one rectangle of the sequence remain in one rectangle
/// after scrambling.
SquarePoint sample_square(const Sampling& sampling, const SampleKey& key, Dimension dimension);
/// The point of a sample on a line from 0 to 1.
double sample_line(const Sampling& sampling, const SampleKey& key, Dimension dimension);

/// A region of the unit square: corner and sides of number `index` of `count` regions.
struct Region {
  double u = 0, v = 0, width = 1, height = 1;
};
Region make_region(int index, int count);
/// Element `index` of a random permutation of 0 .. count - 1, with `count` at least 1 (A. Kensler,
/// "Correlated Multi-Jittered Sampling", 2013).
int permute(int index, int count, std::uint32_t key);

/// Maps the unit square to the unit disc and preserves ratios of areas (P. Shirley and K. Chiu,
/// 1997). Uses no functions of the maths library, so that all hosts get the same bits.
SquarePoint map_to_disc(const SquarePoint& at);

/// Two unit vectors that form an orthonormal basis with the unit vector `axis`.
struct Across {
  Vec u, v;
};
Across make_across(const Vec& axis);

/// Weight of a sample's contribution in the image's sums: 1 / N, or 1 if the number N of samples is
/// not known in advance.
inline double weight_of(const Sampling& s) { return is_adaptive(s) ? 1.0 : 1.0 / s.pixel_samples; }

}  // namespace renderer

#pragma once
// Unbiased adaptive supersampling: a pixel gets more samples if an object's border crosses it or if
// its samples disagree.
//
// Stopping once a pixel's own samples agree is biased: too dark if few samples find a bright thing,
// too bright if few find a dark one. Therefore samples form GROUPS, and each group's number depends
// on the others (compare D. Kirk and J. Arvo, "Unbiased Sampling Techniques for Image Synthesis",
// 1991). The pixel's colour is the mean of the groups' means.

#include <span>

#include "renderer/image/image.hpp"
#include "renderer/trace/sampling.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

/// Results of one sample: its contribution to its pixel, and its primary ray's object.
struct TracedSample {
  Samples::Sums sums;
  std::uint32_t object = NO_OBJECT;
};

/// The objects at a pixel's four corners, see make_probe(). (A straight border across a pixel has
/// corners on both sides.)
using Corners = std::array<std::uint32_t, 4>;

/// Number of samples for the error `Sampling::adaptive`. After n times as many samples, sqrt(n)
/// times this error is allowed, so that every ray reduces the image's error equally.
inline constexpr int ADAPTIVE_SAMPLES = 64;

/// For each group, the number of the pixel's samples when the group finished; 0: not finished.
/// Later samples of the group only affect the other groups' decisions, not the colour.
using Kept = std::array<int, GROUPS>;
/// A group finishes once the *other* groups need no further samples after a round, at the latest
/// after `sampling.pixel_samples`. Its own values do not affect its number of samples, so that
/// their mean is unbiased. `samples` are those that the pixel has, in whole rounds in the order of
/// their passes.
///
/// After the first round, an object's border among samples or corners requires more. After any
/// round, so does a standard error of the mean colour above the limit of `sampling.adaptive`;
/// components are clamped to 0..1 as on a screen.
Kept find_kept(const Sampling& sampling, std::span<const TracedSample> samples,
               const Corners& corners);
/// Number of samples that a pixel should have: its present number if all groups are finished, else
/// another round more.
int find_wanted(const Sampling& sampling, std::span<const TracedSample> samples,
                const Corners& corners);

/// A pixel's samples while their rays are traced one by one, in any order.
struct OpenPixel {
  std::vector<TracedSample> samples;  ///< by pass, once their primary rays are traced
  int wanted = 0;

  OpenPixel() = default;
  explicit OpenPixel(const Sampling& sampling) : wanted(first_round(sampling)) {}
  /// Adds the hit and the contribution of a ray of one of its samples. A sample's primary ray comes
  /// first, and samples begin in order.
  void add(const Ray& ray, const std::optional<Hit>& hit, const Rgb& contribution);
};

/// The displayed colour of a pixel after `samples` samples have begun: their mean. (Fixed numbers
/// of samples have weights, which are corrected until all samples are there.)
Rgb eval_shown(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The colour of a pixel with finished groups: the mean of the groups' means. A group's mean
/// excludes the samples after it finished.
Samples::Sums eval_estimate(const Sampling& sampling, std::span<const TracedSample> samples,
                            const Corners& corners);
/// The pixel's value in render(), from `sums`: the sum over all samples, or with adaptive sampling
/// `samples` times eval_estimate().
Samples::Sums eval_final(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The sums with this mean: the inverse of eval_mean().
Samples::Sums repeat(const Samples::Sums& mean, int samples);
/// The mean over `samples` samples, each component rounded to the nearest unit.
Samples::Sums eval_mean(const Samples::Sums& sums, int samples);

/// A grey picture of the pixels' numbers of samples, 3 bytes each: 0 for at most 1, 255 for the
/// largest of `counts`, logarithmic in between.
std::vector<std::uint8_t> make_count_map(std::span<const std::uint16_t> counts);

}  // namespace renderer

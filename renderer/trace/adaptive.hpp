#pragma once
// Unbiased adaptive supersampling. A pixel gets more samples if the border of an object crosses it,
// or if its samples differ.
//
// It would be biased to stop when a pixel's own samples agree: too dark if few samples find a
// bright object, too bright if few find a dark one. Therefore samples form GROUPS, and the number
// of samples in each group depends only on samples of the other groups (compare D. Kirk and J.
// Arvo, "Unbiased Sampling Techniques for Image Synthesis", 1991). The colour of the pixel is the
// mean of the groups' means.

#include <span>

#include "renderer/image/image.hpp"
#include "renderer/trace/sampling.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

/// Result of one sample: its contribution to its pixel, and the object its primary ray hits.
struct TracedSample {
  Samples::Sums sums;
  std::uint32_t object = NO_OBJECT;
};

/// Objects at the four corners of a pixel (see make_probe()). (If a straight border of an object
/// crosses a pixel, there are corners on both sides.)
using Corners = std::array<std::uint32_t, 4>;

/// Number of samples after which the error `Sampling::adaptive` is allowed. After n times as many
/// samples, sqrt(n) times this error is allowed, so that every ray reduces the image's error
/// equally.
inline constexpr int ADAPTIVE_SAMPLES = 64;

/// For each group, the number of samples that the pixel had when the group finished; 0: not
/// finished. Later samples of the group affect only the decisions of other groups, not the colour.
using Kept = std::array<int, GROUPS>;
/// Finds which groups have finished. A group finishes when the *other* groups need no further
/// samples after a round, and at the latest after `sampling.pixel_samples`. Its own values do not
/// affect its number of samples, so that their mean is unbiased. `samples` are those of the pixel
/// so far, in whole rounds in the order of their passes.
///
/// After the first round, more samples are needed if samples or corners show different objects.
/// After any round, they are needed if the standard error of the mean colour exceeds the limit of
/// `sampling.adaptive`. Components are clamped to 0..1 as on a screen.
Kept find_kept(const Sampling& sampling, std::span<const TracedSample> samples,
               const Corners& corners);
/// Number of samples that a pixel should have: its current number if all groups have finished, else
/// one more round.
int find_wanted(const Sampling& sampling, std::span<const TracedSample> samples,
                const Corners& corners);

/// The samples of a pixel while their rays are traced one by one, in any order.
struct OpenPixel {
  /// indexed by pass, for samples whose primary ray has been traced
  std::vector<TracedSample> samples;
  int wanted = 0;

  OpenPixel() = default;
  explicit OpenPixel(const Sampling& sampling) : wanted(first_round(sampling)) {}
  /// Adds the hit and the contribution of a ray of one of the samples. The primary ray of a sample
  /// must come first, and samples must begin in order.
  void add(const Ray& ray, const std::optional<Hit>& hit, const Rgb& contribution);
};

/// The displayed colour of a pixel after `samples` samples have begun: their mean. (With a fixed
/// number N of samples, contributions have the weight 1 / N; the result is scaled up while fewer
/// samples have begun.)
Rgb eval_shown(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The colour of a pixel whose groups have finished: the mean of the groups' means. Samples that a
/// group got after it had finished do not count.
Samples::Sums eval_estimate(const Sampling& sampling, std::span<const TracedSample> samples,
                            const Corners& corners);
/// The value of the pixel in render(). `sums` is the sum over all samples, or with adaptive
/// sampling, `samples` times eval_estimate().
Samples::Sums eval_final(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The sums with this mean: the inverse of eval_mean().
Samples::Sums repeat(const Samples::Sums& mean, int samples);
/// The mean over `samples` samples, each component rounded to the nearest unit.
Samples::Sums eval_mean(const Samples::Sums& sums, int samples);

/// A grey picture of the number of samples at each pixel, 3 bytes each: 0 for at most 1, 255 for
/// the largest of `counts`, logarithmic in between.
std::vector<std::uint8_t> make_count_map(std::span<const std::uint16_t> counts);

}  // namespace renderer

#pragma once
// Unbiased adaptive supersampling. A pixel gets more samples if the border of an object crosses it,
// or if its samples differ.
//
// To stop when a pixel's own samples agree would be biased: the pixel would be too dark if few
// samples find a bright object, and too bright if few find a dark one. Therefore, the samples form
// GROUPS groups, and the number of samples in each group depends only on the samples of the other
// groups (compare D. Kirk and J. Arvo, "Unbiased Sampling Techniques for Image Synthesis", 1991).
// The colour of the pixel is the mean of the groups' means.

#include <span>

#include "renderer/image/image.hpp"
#include "renderer/trace/sampling.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

/// Result of one sample: its contribution to the pixel, and the object that its ray from the eye
/// hits.
struct TracedSample {
  Samples::Sums sums;
  std::uint32_t object = NO_OBJECT;
};

/// Objects seen at the four corners of a pixel (see make_probe()). (If a straight border of an
/// object crosses a pixel, the corners are on both sides of it.)
using Corners = std::array<std::uint32_t, 4>;

/// Number of samples after which the error `Sampling::adaptive` is allowed. After n times this
/// number, sqrt(n) times the error is allowed. Every ray then reduces the image's error equally.
inline constexpr int ADAPTIVE_SAMPLES = 64;

/// For each group, the number of the pixel's samples when the group finished; 0 if the group has
/// not finished. Later samples of the group affect only the decisions of other groups, not the
/// colour.
using Kept = std::array<int, GROUPS>;
/// Finds which groups have finished. Samples are taken in rounds. A group finishes when the *other*
/// groups need no further samples after a round, and at the latest after `sampling.pixel_samples`.
/// Its own values do not affect its number of samples, so that their mean is unbiased. `samples`
/// has the samples of complete rounds, in the order of Ray::pass.
///
/// After the first round, more samples are needed if samples or corners show different objects.
/// After any round, they are needed if the standard error of the mean colour exceeds the limit of
/// `sampling.adaptive`. Colour components are clamped to 0..1, as on a screen.
Kept find_kept(const Sampling& sampling, std::span<const TracedSample> samples,
               const Corners& corners);
/// The number of samples that a pixel should have: the current number if all groups have finished,
/// otherwise one more round.
int find_wanted(const Sampling& sampling, std::span<const TracedSample> samples,
                const Corners& corners);

/// The samples of a pixel while their rays are traced one by one, in any order.
struct OpenPixel {
  /// By Ray::pass: the samples whose ray from the eye has been traced.
  std::vector<TracedSample> samples;
  int wanted = 0;

  OpenPixel() = default;
  explicit OpenPixel(const Sampling& sampling) : wanted(first_round(sampling)) {}
  /// Adds the result of a ray of one of the samples: its hit and its contribution. The primary ray
  /// of a sample must come before its other rays, and samples must begin in the order of Ray::pass.
  void add(const Ray& ray, const std::optional<Hit>& hit, const Rgb& contribution);
};

/// The colour to display for a pixel after `samples` of its samples have begun: their mean. (With a
/// fixed number N of samples, contributions have the weight 1 / N; the result is scaled up while
/// fewer than N samples have begun.)
Rgb eval_shown(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The colour of a pixel whose groups have all finished: the mean of the groups' means. Samples of
/// a group after its end do not count.
Samples::Sums eval_estimate(const Sampling& sampling, std::span<const TracedSample> samples,
                            const Corners& corners);
/// The value of the pixel in the picture of render(). `sums` is the sum over all samples; with
/// adaptive sampling, it is eval_estimate() multiplied by `samples`.
Samples::Sums eval_final(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The sums that have this mean over `samples` samples: the inverse of eval_mean().
Samples::Sums repeat(const Samples::Sums& mean, int samples);
/// The mean over `samples` samples, each component rounded to the nearest unit.
Samples::Sums eval_mean(const Samples::Sums& sums, int samples);

/// A grey picture of the number of samples at each pixel, 3 bytes per pixel: 0 for at most 1
/// sample, 255 for the largest of `counts`, logarithmic in between.
std::vector<std::uint8_t> make_count_map(std::span<const std::uint16_t> counts);

}  // namespace renderer

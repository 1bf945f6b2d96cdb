#pragma once
// Adaptive supersampling without bias: a pixel has more samples where an object's border crosses it
// or where its samples disagree.
//
// A pixel that stops as soon as its own samples agree is too dark where few samples find a bright
// thing, and too bright where few find a dark one. So its samples form GROUPS, and each group's
// number of samples is decided by the others (compare D. Kirk and J. Arvo, "Unbiased Sampling
// Techniques for Image Synthesis", 1991). The pixel's colour is the mean of the groups' means.

#include <span>

#include "renderer/image/image.hpp"
#include "renderer/trace/sampling.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

/// What one sample has found: what it contributes to its pixel, and the object that its primary ray
/// meets.
struct TracedSample {
  Samples::Sums sums;
  std::uint32_t object = NO_OBJECT;
};

/// The objects at a pixel's four corners, see make_probe(). (A straight border that crosses a pixel
/// has a corner on either side of it.)
using Corners = std::array<std::uint32_t, 4>;

/// After so many samples the error may be what `Sampling::adaptive` says, after n times as many
/// sqrt(n) times that: so a ray removes as much of the image's error wherever it goes.
inline constexpr int ADAPTIVE_SAMPLES = 64;

/// By group, the number of the pixel's samples when the group is finished; 0: not yet. The group's
/// later samples count for the other groups' decisions alone, not for the colour.
using Kept = std::array<int, GROUPS>;
/// A group is finished after the first round in which the samples of the *other* groups call for no
/// more, at the latest after `sampling.pixel_samples`. Its own values have no effect on its number
/// of samples, so that their mean has no bias. `samples` are those that the pixel has, whole rounds
/// in the order of their passes.
///
/// An object's border, seen by samples or corners, calls for more after the first round. After any
/// round, so does a standard error of the mean of the colours, each component as a screen shows it
/// (0 to 1), that is above what `sampling.adaptive` allows.
Kept find_kept(const Sampling& sampling, std::span<const TracedSample> samples,
               const Corners& corners);
/// How many samples a pixel should have: as many as it has, if all of its groups are finished, else
/// another round.
int find_wanted(const Sampling& sampling, std::span<const TracedSample> samples,
                const Corners& corners);

/// A pixel's samples while their rays are traced one by one, in any order.
struct OpenPixel {
  std::vector<TracedSample> samples;  ///< by pass, those whose primary ray has been traced
  int wanted = 0;

  OpenPixel() = default;
  explicit OpenPixel(const Sampling& sampling) : wanted(first_round(sampling)) {}
  /// What a ray of one of its samples has met and contributes. A sample's primary ray comes first,
  /// and samples begin in their order.
  void add(const Ray& ray, const std::optional<Hit>& hit, const Rgb& contribution);
};

/// The colour that a pixel shows when so many of its samples have begun: their mean. (Fixed numbers
/// of samples have their weights, which are made up for until all are there.)
Rgb eval_shown(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The colour of a pixel whose groups are finished: the mean of the groups' means, each over the
/// samples that the group had when it was finished.
Samples::Sums eval_estimate(const Sampling& sampling, std::span<const TracedSample> samples,
                            const Corners& corners);
/// What render() gives for a pixel from `sums`: of all its samples, or with adaptive sampling
/// `samples` times eval_estimate().
Samples::Sums eval_final(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The sums of which eval_mean() is this mean.
Samples::Sums repeat(const Samples::Sums& mean, int samples);
/// The mean of as many samples, each component rounded to the nearest unit.
Samples::Sums eval_mean(const Samples::Sums& sums, int samples);

/// A picture of how many samples pixels have had, 3 bytes each, in grey: 0 where that is at most 1,
/// 255 where it is the largest of `counts`, and in between by the logarithm.
std::vector<std::uint8_t> make_count_map(std::span<const std::uint16_t> counts);

}  // namespace renderer

#pragma once
// Adaptive supersampling: more samples where an object's border crosses a pixel or its samples
// disagree, none where no ray meets anything.

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

/// How many samples a pixel should have. `samples` are those that it has, whole rounds in the order
/// of their passes; as many: it is finished. Where all rays miss, that is after the first round. An
/// object's border calls for more after the first two rounds; after any but the first, so does a
/// standard error of the mean of its colours, each component as a screen shows it (0 to 1), that is
/// above what `sampling.adaptive` allows.
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

/// The sum of the samples' contributions.
Samples::Sums add_up(std::span<const TracedSample> samples);
/// The colour that a pixel shows when so many of its samples have begun: their mean. (Fixed numbers
/// of samples have their weights, which are made up for until all are there.)
Rgb eval_shown(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// What render() gives for a pixel from the sums of all its samples: with adaptive sampling their
/// mean.
Samples::Sums eval_final(const Sampling& sampling, const Samples::Sums& sums, int samples);
/// The mean of as many samples, each component rounded to the nearest unit.
Samples::Sums eval_mean(const Samples::Sums& sums, int samples);

/// A picture of how many samples pixels have had, 3 bytes each, in grey: 0 where that is at most 1,
/// 255 where it is the largest of `counts`, and in between by the logarithm.
std::vector<std::uint8_t> make_count_map(std::span<const std::uint16_t> counts);

}  // namespace renderer

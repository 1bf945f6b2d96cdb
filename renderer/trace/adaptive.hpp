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

/// How many samples a pixel should have. `samples` are those that it has, whole rounds in the order
/// of their passes; as many: it is finished. Where all rays miss, that is after the first round. An
/// object's border calls for more after the first two rounds, and whatever it is, after any but the
/// first, the standard error of the mean of its colours, each component as a screen shows it (0 to
/// 1), if it is above `sampling.adaptive`.
int find_wanted(const Sampling& sampling, std::span<const TracedSample> samples,
                const Corners& corners);

/// The sum of the samples' contributions.
Samples::Sums add_up(std::span<const TracedSample> samples);
/// The mean of as many samples, each component rounded to the nearest unit.
Samples::Sums eval_mean(const Samples::Sums& sums, int samples);

}  // namespace renderer

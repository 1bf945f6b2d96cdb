#include "renderer/trace/adaptive.hpp"

#include <algorithm>

namespace renderer {

namespace {

bool has_border(std::span<const TracedSample> samples, const Corners& corners) {
  const std::uint32_t object = corners[0];
  return !std::ranges::all_of(corners, [&](std::uint32_t other) { return other == object; }) ||
         !std::ranges::all_of(samples, [&](const auto& s) { return s.object == object; });
}

// The sum of the squares of what a component of samples first, first + step ... is from their mean,
// for one sample less than there are; times their number.
double eval_spread(std::span<const TracedSample> samples, std::size_t first, std::size_t step,
                   double Rgb::*component) {
  double sum = 0, squares = 0, n = 0;
  for (std::size_t i = first; i < samples.size(); i += step) {
    const double shown = std::clamp(to_rgb(samples[i].sums).*component, 0.0, 1.0);
    sum += shown;
    squares += shown * shown;
    ++n;
  }
  return n > 1 ? (squares - sum * sum / n) * n / (n - 1) : 0;
}

// The largest of the components' standard errors, squared. Two or four samples share a region of
// the pixel (see sample_square()): how they differ there is all that is not known of it.
double eval_error_square(std::span<const TracedSample> samples) {
  std::size_t regions = 1;
  while (4 * regions < samples.size()) regions *= 4;
  double largest = 0;
  for (const auto component : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    double sum = 0;
    for (std::size_t i = 0; i < regions; ++i) sum += eval_spread(samples, i, regions, component);
    largest = std::max(largest, sum);
  }
  const auto n = static_cast<double>(samples.size());
  return largest / (n * n);
}

}  // namespace

int find_wanted(const Sampling& s, std::span<const TracedSample> samples, const Corners& corners) {
  const int has = static_cast<int>(samples.size());
  if (has >= s.pixel_samples || has < 2) return has;
  const bool border = has_border(samples, corners);
  if (!border && corners[0] == NO_OBJECT) return has;
  const int second_round = round_of(s, first_round(s)).count + first_round(s);
  const bool is_early = has < second_round || (has == second_round && border);
  if (!is_early && !(eval_error_square(samples) > s.adaptive * s.adaptive)) return has;
  return has + round_of(s, has).count;
}

Samples::Sums add_up(std::span<const TracedSample> samples) {
  Samples::Sums sums;
  for (const auto& sample : samples) add(sums, sample.sums);
  return sums;
}

Samples::Sums eval_mean(const Samples::Sums& sums, int samples) {
  const auto divide = [n = static_cast<std::int64_t>(samples)](std::int64_t sum) {
    const std::int64_t half = sum < 0 ? -n / 2 : n / 2;
    return (sum + half) / n;
  };
  return {divide(sums.r), divide(sums.g), divide(sums.b)};
}

}  // namespace renderer

#include "renderer/trace/adaptive.hpp"

#include <algorithm>

namespace renderer {

namespace {

bool has_border(std::span<const TracedSample> samples, const Corners& corners) {
  const std::uint32_t object = corners[0];
  return !std::ranges::all_of(corners, [&](std::uint32_t other) { return other == object; }) ||
         !std::ranges::all_of(samples, [&](const auto& s) { return s.object == object; });
}

// How often samples were in a square of the pixel, and what they were.
struct Square {
  int count = 0;
  Rgb sum, squares;
};

// The largest of the components' standard errors, squared. The pixel is divided into squares that
// have two or four samples each (see sample_square()): how they differ there is all that is not
// known of it.
double eval_error_square(std::span<const TracedSample> samples) {
  int levels = 0;
  while (std::size_t{4} << (2 * levels) < samples.size()) ++levels;
  std::vector<Square> squares(std::size_t{1} << (2 * levels));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto [u, v] = eval_sequence(static_cast<std::uint32_t>(i));
    const auto find = [&](std::uint32_t at) { return std::uint64_t{at} >> (32 - levels); };
    Square& square = squares[find(v) << levels | find(u)];
    const Rgb colour = to_rgb(samples[i].sums);
    const auto show = [](double component) { return std::clamp(component, 0.0, 1.0); };
    const Rgb shown{show(colour.r), show(colour.g), show(colour.b)};
    ++square.count;
    square.sum += shown;
    square.squares += shown * shown;
  }
  Rgb all;
  for (const auto& [count, sum, sum_of_squares] : squares)
    if (count > 1) all += (1.0 / (count - 1)) * (count * sum_of_squares + -1.0 * sum * sum);
  const auto n = static_cast<double>(samples.size());
  return max_component(all) / (n * n);
}

}  // namespace

int find_wanted(const Sampling& s, std::span<const TracedSample> samples, const Corners& corners) {
  const int has = static_cast<int>(samples.size());
  if (has >= s.pixel_samples || has < 2) return has;
  const bool border = has_border(samples, corners);
  if (!border && corners[0] == NO_OBJECT) return has;
  const int second_round = round_of(s, first_round(s)).count + first_round(s);
  const bool is_early = has < second_round || (has == second_round && border);
  const double allowed = s.adaptive * s.adaptive * has / ADAPTIVE_SAMPLES;
  if (!is_early && !(eval_error_square(samples) > allowed)) return has;
  return has + round_of(s, has).count;
}

void OpenPixel::add(const Ray& ray, const std::optional<Hit>& hit, const Rgb& contribution) {
  if (ray.level == 1) samples.push_back({{}, hit ? hit->object : NO_OBJECT});
  renderer::add(samples.at(ray.pass).sums, contribution);
}

Samples::Sums add_up(std::span<const TracedSample> samples) {
  Samples::Sums sums;
  for (const auto& sample : samples) add(sums, sample.sums);
  return sums;
}

Rgb eval_shown(const Sampling& sampling, const Samples::Sums& sums, int samples) {
  if (samples < 2 && sampling.pixel_samples == 1) return to_rgb(sums);
  const int n = std::max(1, samples);
  if (is_adaptive(sampling)) return to_rgb(eval_final(sampling, sums, n));
  return static_cast<double>(sampling.pixel_samples) / n * to_rgb(sums);
}

Samples::Sums eval_final(const Sampling& sampling, const Samples::Sums& sums, int samples) {
  return is_adaptive(sampling) ? eval_mean(sums, std::max(1, samples)) : sums;
}

std::vector<std::uint8_t> make_count_map(std::span<const std::uint16_t> counts) {
  const int most = counts.empty() ? 0 : *std::ranges::max_element(counts);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * counts.size());
  for (const std::uint16_t count : counts) {
    // Rounded, so that it is the same whichever library computes the logarithms.
    const auto share = count > 1 ? static_cast<float>(std::log(count) / std::log(most)) : 0.0F;
    bytes.insert(bytes.end(), 3, static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  return bytes;
}

Samples::Sums eval_mean(const Samples::Sums& sums, int samples) {
  const auto divide = [n = static_cast<std::int64_t>(samples)](std::int64_t sum) {
    const std::int64_t half = sum < 0 ? -n / 2 : n / 2;
    return (sum + half) / n;
  };
  return {divide(sums.r), divide(sums.g), divide(sums.b)};
}

}  // namespace renderer

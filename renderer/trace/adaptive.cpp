#include "renderer/trace/adaptive.hpp"

#include <algorithm>

namespace renderer {

namespace {

// Number, sum and sum of squares of the samples in one square part of the pixel.
struct Square {
  int count = 0;
  Rgb sum, squares;
};

// Estimates the squared standard error of the pixel's mean, as the maximum over the colour
// components. Uses all groups of samples except `own`. The pixel is divided into squares with two
// or four samples each. Only the variance within squares contributes, because samples are
// stratified.
double eval_error_square(std::span<const TracedSample> samples, int own) {
  int levels = 0;
  while (std::size_t{4} << (2 * levels) < samples.size()) ++levels;
  std::vector<Square> squares(std::size_t{1} << (2 * levels));
  for (int pass = 0; pass < static_cast<int>(samples.size()); ++pass) {
    if (group_of(pass) == own) continue;
    const auto [u, v] = eval_pixel_sequence(pass);
    const auto find = [&](std::uint32_t at) { return std::uint64_t{at} >> (32 - levels); };
    Square& square = squares[find(v) << levels | find(u)];
    const Rgb colour = to_rgb(samples[static_cast<std::size_t>(pass)].sums);
    const auto show = [](double component) { return std::clamp(component, 0.0, 1.0); };
    const Rgb shown{show(colour.r), show(colour.g), show(colour.b)};
    ++square.count;
    square.sum += shown;
    square.squares += shown * shown;
  }
  Rgb all;
  for (const auto& [count, sum, sum_of_squares] : squares)
    if (count > 1) all += (1.0 / (count - 1)) * (count * sum_of_squares + -1.0 * sum * sum);
  constexpr double ALL_OVER_OTHERS = double{GROUPS} / (GROUPS - 1);
  const auto n = static_cast<double>(samples.size());
  return ALL_OVER_OTHERS * max_component(all) / (n * n);
}

bool has_border(std::span<const TracedSample> samples, int own, const Corners& corners) {
  for (int pass = 0; pass < static_cast<int>(samples.size()); ++pass)
    if (group_of(pass) != own && samples[static_cast<std::size_t>(pass)].object != corners[0])
      return true;
  return !std::ranges::all_of(corners, [&](auto object) { return object == corners[0]; });
}

// True if the samples of all groups except `own` show that the pixel needs no further samples.
bool is_enough(const Sampling& s, std::span<const TracedSample> samples, int own,
               const Corners& corners) {
  if (samples.size() == FIRST_ROUND && has_border(samples, own, corners)) return false;
  const double allowed =
      s.adaptive * s.adaptive * static_cast<double>(samples.size()) / ADAPTIVE_SAMPLES;
  return !(eval_error_square(samples, own) > allowed);
}

}  // namespace

Kept find_kept(const Sampling& s, std::span<const TracedSample> samples, const Corners& corners) {
  const int has = static_cast<int>(samples.size());
  Kept kept{};
  for (int end = first_round(s); end <= has; end += round_of(s, end).count) {
    const bool is_last = end >= s.pixel_samples;
    const auto begun = samples.first(static_cast<std::size_t>(end));
    for (int group = 0; group < GROUPS; ++group) {
      int& own = kept[static_cast<std::size_t>(group)];
      if (own == 0 && (is_last || is_enough(s, begun, group, corners))) own = end;
    }
    if (is_last) break;
  }
  return kept;
}

int find_wanted(const Sampling& s, std::span<const TracedSample> samples, const Corners& corners) {
  const int has = static_cast<int>(samples.size());
  if (has >= s.pixel_samples) return has;
  const bool is_finished =
      std::ranges::all_of(find_kept(s, samples, corners), [](int kept) { return kept > 0; });
  return is_finished ? has : has + round_of(s, has).count;
}

void OpenPixel::add(const Ray& ray, const std::optional<Hit>& hit, const Rgb& contribution) {
  if (ray.level == 1) samples.push_back({{}, hit ? hit->object : NO_OBJECT});
  renderer::add(samples.at(ray.pass).sums, contribution);
}

Samples::Sums eval_estimate(const Sampling& sampling, std::span<const TracedSample> samples,
                            const Corners& corners) {
  const Kept kept = find_kept(sampling, samples, corners);
  std::array<Samples::Sums, GROUPS> sums;
  std::array<int, GROUPS> counts{};
  for (int pass = 0; pass < static_cast<int>(samples.size()); ++pass) {
    const auto group = static_cast<std::size_t>(group_of(pass));
    if (pass >= kept[group]) continue;
    add(sums[group], samples[static_cast<std::size_t>(pass)].sums);
    ++counts[group];
  }
  Samples::Sums all;
  if (std::ranges::all_of(counts, [&](int count) { return count == counts[0]; })) {
    for (const auto& group : sums) add(all, group);
    return eval_mean(all, GROUPS * counts[0]);
  }
  for (std::size_t group = 0; group < GROUPS; ++group)
    add(all, eval_mean(sums[group], counts[group]));
  return eval_mean(all, GROUPS);
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
    // Rounded to float, so that the result does not depend on the host's maths library.
    const auto share = count > 1 ? static_cast<float>(std::log(count) / std::log(most)) : 0.0F;
    bytes.insert(bytes.end(), 3, static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  return bytes;
}

Samples::Sums repeat(const Samples::Sums& mean, int samples) {
  const auto product = [times = static_cast<std::uint64_t>(samples)](std::int64_t sum) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) * times);
  };
  return {product(mean.r), product(mean.g), product(mean.b)};
}

Samples::Sums eval_mean(const Samples::Sums& sums, int samples) {
  const auto divide = [n = static_cast<std::int64_t>(samples)](std::int64_t sum) {
    const std::int64_t half = sum < 0 ? -n / 2 : n / 2;
    return (sum + half) / n;
  };
  return {divide(sums.r), divide(sums.g), divide(sums.b)};
}

}  // namespace renderer

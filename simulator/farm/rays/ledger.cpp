#include "simulator/farm/rays/ledger.hpp"

namespace farm {

namespace {

std::uint32_t corner_number(const renderer::Params& params, int x, int y) {
  return static_cast<std::uint32_t>(y * (params.width + 1) + x);
}

}  // namespace

Ledger::Ledger(const renderer::Params& params) : params_(params), area_(get_area(params)) {}

std::vector<std::pair<int, int>> Ledger::ask_corners(std::uint32_t pixel) {
  const int x = static_cast<int>(pixel) % params_.width,
            y = static_cast<int>(pixel) / params_.width;
  std::vector<std::pair<int, int>> corners;
  for (int i = 0; i < 4; ++i)
    if (asked_.insert(corner_number(params_, x + i % 2, y + i / 2)).second)
      corners.emplace_back(x + i % 2, y + i / 2);
  return corners;
}

std::vector<std::uint32_t> Ledger::note_corner(std::uint32_t corner, std::uint32_t object) {
  corners_[corner] = object;
  const int x = static_cast<int>(corner) % (params_.width + 1);
  const int y = static_cast<int>(corner) / (params_.width + 1);
  std::vector<std::uint32_t> pixels;
  for (int py = std::max(y - 1, area_.y); py <= y && py < area_.y + area_.height; ++py)
    for (int px = std::max(x - 1, area_.x); px <= x && px < area_.x + area_.width; ++px) {
      const auto pixel = static_cast<std::uint32_t>(py * params_.width + px);
      if (find_corners(pixel)) pixels.push_back(pixel);
    }
  return pixels;
}

void Ledger::note(const renderer::Ray& ray, const std::optional<renderer::Hit>& hit,
                  const renderer::Rgb& contribution, std::size_t children) {
  Pixel& pixel = open_.try_emplace(ray.sample, params_.sampling).first->second;
  pixel.under_way += children;
  if (ray.level == 1)
    ++held_;
  else
    --pixel.under_way;
  pixel.add(ray, hit, contribution);
}

std::optional<int> Ledger::next_sample(std::uint32_t number) {
  const auto open = open_.find(number);
  if (open == open_.end()) return std::nullopt;
  Pixel& pixel = open->second;
  const int has = static_cast<int>(pixel.samples.size());
  if (has < pixel.begun) return std::nullopt;
  if (has == pixel.wanted) {
    const auto corners = find_corners(number);
    if (pixel.under_way > 0 || !corners) return std::nullopt;
    pixel.wanted = find_wanted(params_.sampling, pixel.samples, *corners);
    if (pixel.wanted == has) {
      finish(number, pixel, *corners);
      held_ -= pixel.samples.size();
      open_.erase(open);
      return std::nullopt;
    }
  }
  return pixel.begun++;
}

void Ledger::finish(std::uint32_t number, const Pixel& pixel, const renderer::Corners& corners) {
  const auto estimate = eval_estimate(params_.sampling, pixel.samples, corners);
  const int count = static_cast<int>(pixel.samples.size());
  renderer::Samples::Sums sums;
  for (const auto& sample : pixel.samples) add(sums, sample.sums);
  if (eval_mean(sums, count) != estimate) finished_.push_back({number, repeat(estimate, count)});
}

std::optional<renderer::Corners> Ledger::find_corners(std::uint32_t pixel) const {
  const int x = static_cast<int>(pixel) % params_.width,
            y = static_cast<int>(pixel) / params_.width;
  renderer::Corners corners;
  for (int i = 0; i < 4; ++i) {
    const auto known = corners_.find(corner_number(params_, x + i % 2, y + i / 2));
    if (known == corners_.end()) return std::nullopt;
    corners[static_cast<std::size_t>(i)] = known->second;
  }
  return corners;
}

}  // namespace farm

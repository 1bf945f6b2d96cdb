#include "renderer/progressive/progressive.hpp"

#include <atomic>
#include <future>
#include <mutex>

#include "renderer/progressive/pyramid.hpp"

namespace renderer::progressive {

double get_repeated_percent(const TreeRays& rays) {
  const auto fresh = rays.fresh.total();
  return fresh > 0 ? 100.0 * static_cast<double>(rays.repeated) / static_cast<double>(fresh) : 0;
}

Progressive::Progressive(const Scene& scene, const Params& params, int max_cell, int threads)
    : scene_(scene), params_(params), max_cell_(max_cell), threads_(threads) {
  params_.area = {};
  check(Step{}, params_, max_cell);
  sampled_ = Sampled(params.width, params.height);
  seen_.resize(object_count(scene));
}

std::optional<StepCounts> Progressive::advance(const Step& step, const Stop& is_stopped) {
  check(step, params_, max_cell_);
  Step whole = step;
  if (step.area == Area{}) whole.area = {0, 0, params_.width, params_.height};
  StepCounts counts;
  if (cells_.empty()) {
    cells_ = make_cells(params_.width, params_.height, max_cell_);
    for (const Cell& cell : cells_) want_corners(cell, step.depth);
  }
  for (const Cell& cell : cells_)
    if (meets(cell, whole.area)) deepen_border(cell, step.depth);
  do {
    if (!trace_wanted(step.depth, is_stopped, counts)) return std::nullopt;
  } while (divide_cells(whole, counts));
  counts.cells = cells_.size();
  return counts;
}

void Progressive::want(int x, int y, int depth) {
  auto& levels = sampled_.levels[sampled_.index(x, y)];
  if (levels >= depth) return;
  wanted_.push_back({x, y, levels});
  levels = static_cast<std::uint16_t>(depth);
}

void Progressive::want_corners(const Cell& c, int depth) {
  for (const int y : {c.y0, c.y1})
    for (const int x : {c.x0, c.x1}) want(x, y, depth);
}

void Progressive::deepen_border(const Cell& c, int depth) {
  for (int y = c.y0; y <= c.y1; ++y)
    for (int x = c.x0; x <= c.x1; ++x)
      if (sampled_.has(x, y)) want(x, y, depth);
}

// Traces the samples in `wanted_`, in parallel. Each thread repeatedly takes the next sample.
// Samples have separate data, and the sums of counts do not depend on the order of threads. Returns
// false if `is_stopped` ended the step.
bool Progressive::trace_wanted(int depth, const Stop& is_stopped, StepCounts& counts) {
  for (const Wanted& wanted : wanted_) ++(wanted.from > 0 ? counts.deepened : counts.samples);
  std::vector<std::uint32_t> hits(wanted_.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> was_stopped = false;
  std::mutex one_by_one;
  const auto trace = [&] {
    TreeRays rays;
    Children stack;
    for (auto i = next++; i < wanted_.size(); i = next++) {
      if (is_stopped()) was_stopped = true;
      if (was_stopped) return;
      const Wanted& w = wanted_[i];
      hits[i] = deepen(scene_, params_, w.x, w.y, w.from, depth, sampled_.samples, rays, stack);
    }
    const std::lock_guard lock(one_by_one);
    counts.rays += rays;
  };
  std::vector<std::future<void>> helpers;
  const auto threads = std::min(wanted_.size(), static_cast<std::size_t>(threads_));
  for (std::size_t i = 1; i < threads; ++i)
    helpers.push_back(std::async(std::launch::async, trace));
  trace();
  for (auto& helper : helpers) helper.get();
  if (was_stopped) return false;
  for (const auto object : hits)
    if (object != NO_OBJECT) seen_[object] = true;
  wanted_.clear();
  return true;
}

// Divides the cells that must be divided. Evaluates all cells before it divides any, so that the
// result does not depend on their order. Returns true if it divided any cell.
bool Progressive::divide_cells(const Step& step, StepCounts& counts) {
  std::vector<Verdict> verdicts;
  for (const Cell& cell : cells_) verdicts.push_back(judge(cell, step, counts));
  std::vector<Cell> after;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (verdicts[i] == Verdict::keep) {
      after.push_back(cells_[i]);
      continue;
    }
    ++(verdicts[i] == Verdict::contrast ? counts.by_contrast : counts.by_pyramid);
    for (const Cell& part : divide(cells_[i])) {
      want_corners(part, step.depth);
      after.push_back(part);
    }
  }
  const bool is_divided = after.size() > cells_.size();
  cells_ = std::move(after);
  return is_divided;
}

Progressive::Verdict Progressive::judge(const Cell& cell, const Step& step,
                                        StepCounts& counts) const {
  if (get_size(cell) <= step.min_cell || !meets(cell, step.area)) return Verdict::keep;
  if (step.contrast == 0 || eval_contrast(find_range(cell, sampled_)) > step.contrast)
    return Verdict::contrast;
  if (!step.pyramid) return Verdict::keep;
  const Pyramid pyramid(scene_, make_plane_point(scene_.view, params_, cell.x0, cell.y0),
                        make_plane_point(scene_.view, params_, cell.x1, cell.y1));
  return holds_unseen(scene_, pyramid, seen_, counts.boxes) ? Verdict::pyramid : Verdict::keep;
}

Samples Progressive::make_picture() const {
  Samples picture = sampled_.samples;
  for (const Cell& cell : cells_) interpolate(cell, sampled_, picture);
  return picture;
}

}  // namespace renderer::progressive

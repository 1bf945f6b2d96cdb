#include "simulator/snapshots/quality_curve.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/image/animation.hpp"
#include "renderer/quality/quality.hpp"
#include "renderer/quality/quality_curve.hpp"

namespace snapshots {

namespace {

renderer::Bitmap make_bitmap(const Snapshot& shown, int width) {
  return {width, static_cast<int>(shown.rgb8.size()) / 3 / width, shown.rgb8};
}

base::Cell make_cell(const std::optional<std::uint64_t>& count) {
  if (!count) return {};
  return static_cast<std::int64_t>(*count);
}

}  // namespace

base::Columns<Figures> figure_columns() {
  using base::column;
  return {column("growth_mean", &Figures::area,
                 "mean structural similarity of the picture to the final one, over time_s"),
          column("growth_50_s", &Figures::to_50_s,
                 "time after which the similarity stays at least 50 %"),
          column("growth_90_s", &Figures::to_90_s,
                 "time after which the similarity stays at least 90 %"),
          column("growth_99_s", &Figures::to_99_s,
                 "time after which the similarity stays at least 99 %")};
}

QualityCurve make_quality_curve(const std::vector<Snapshot>& pictures, int width, int max_cell) {
  if (pictures.empty()) return {};
  // Borders of larger cells are also borders of cells with sides of 4 pixels. Drawing only the
  // borders of the small cells therefore shows all borders.
  const int side = std::min(max_cell, 4);
  const auto last = make_bitmap(pictures.back(), width);
  QualityCurve growth;
  std::vector<renderer::QualityPoint> curve;
  for (const auto& shown : pictures) {
    const auto bitmap = make_bitmap(shown, width);
    const double quality = renderer::ssim(bitmap, last);
    curve.push_back({.time_s = shown.at_s, .quality = quality});
    base::Cell border;
    if (side >= renderer::MIN_BORDERED_CELL) border = renderer::border_energy(bitmap, side);
    growth.rows.push_back({{"growth_s", shown.at_s},
                           {"rays_shown", make_cell(shown.rays)},
                           {"cycles_spent", make_cell(shown.cycles)},
                           {"rmse", renderer::rmse(bitmap, last)},
                           {"ssim", quality},
                           {"border_energy", border}});
  }
  const auto figures = renderer::eval_quality_curve(curve);
  growth.figures = {figures.area, figures.to_50, figures.to_90, figures.to_99};
  return growth;
}

programs::Image make_movie(const std::string& name, const std::vector<Snapshot>& pictures,
                           int width) {
  const double end_s = std::max(pictures.back().at_s, 1e-9);
  std::vector<renderer::Frame> frames;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const double until_s = i + 1 < pictures.size() ? pictures[i + 1].at_s : end_s;
    const double shown_s = MOVIE_S * (until_s - pictures[i].at_s) / end_s;
    const double more_s = i + 1 < pictures.size() ? 0 : LAST_S;
    const int ms = static_cast<int>(std::lround(1e3 * (shown_s + more_s)));
    frames.push_back({make_bitmap(pictures[i], width), std::max(1, ms)});
  }
  const auto kept = std::make_shared<const std::vector<renderer::Frame>>(std::move(frames));
  programs::Image image;
  image.name = name;
  image.at_s = pictures.back().at_s;
  image.save = [kept](const std::string& path) { renderer::save_webp(path, *kept); };
  image.is_named = true;
  image.extension = ".webp";
  return image;
}

}  // namespace snapshots

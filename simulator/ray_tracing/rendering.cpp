#include "simulator/ray_tracing/rendering.hpp"

#include <fmt/format.h>

#include "simulator/kernels/kernels.hpp"
#include "simulator/ray_tracing/busy.hpp"

namespace ray_tracing {

using base::Cell;
using base::column;
using base::Columns;

namespace {

bool is_of_stage(const KeyImage& image) { return image.name.starts_with("stage"); }

// For each stage except the last, the date of its end, at which a key image (a copy of the picture)
// was saved.
std::vector<Cell> stage_cells(const Rendering& r) {
  std::vector<Cell> cells;
  for (const auto& image : r.key_images)
    if (is_of_stage(image)) cells.emplace_back(image.at.value - r.setup_s);
  return cells;
}

std::vector<Cell> lit_cells(const Rendering& r) {
  std::vector<Cell> cells;
  for (const auto& image : r.key_images) {
    if (!is_of_stage(image)) continue;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < image.rgb8.size(); i += 3)
      lit += image.rgb8[i] > 0 || image.rgb8[i + 1] > 0 || image.rgb8[i + 2] > 0;
    cells.emplace_back(static_cast<double>(3 * lit) / static_cast<double>(image.rgb8.size()));
  }
  return cells;
}

programs::Image make_image(const renderer::Params& image, const std::string& name,
                           std::optional<double> at_s, std::vector<std::uint8_t> rgb8) {
  const auto kept = std::make_shared<const std::vector<std::uint8_t>>(std::move(rgb8));
  const int width = image.width, height = image.height;
  return {.name = name,
          .at_s = at_s,
          .save = [=](const std::string& path) { renderer::save_png(path, width, height, *kept); },
          .is_named = true};
}

std::vector<programs::Image> make_images(const std::string& name, const renderer::Params& image,
                                         const Rendering& r) {
  std::vector<programs::Image> images;
  const auto add = [&](const std::string& suffix, std::optional<double> at_s, const auto& rgb8) {
    images.push_back(make_image(image, name + suffix, at_s, rgb8));
  };
  add("", r.is_aborted ? std::optional(r.time_s) : std::nullopt, r.rgb8);
  for (const auto& key : r.key_images)
    add("-" + key.name, std::max(0.0, key.at.value - r.setup_s), key.rgb8);
  for (std::size_t i = 0; i < r.pictures.size(); ++i)
    add(fmt::format("-shown{}", i + 1), r.pictures[i].at_s, r.pictures[i].rgb8);
  if (!r.growth.empty())
    images.push_back(snapshots::make_movie(name + "-growth", r.growth, image.width));
  return images;
}

}  // namespace

std::vector<std::uint8_t> render_sequentially(const renderer::Scene& scene,
                                              const renderer::Params& params,
                                              const std::function<bool()>& goes_on) {
  bool is_whole = true;
  const auto rendering = renderer::render(scene, params, 1, [&](int done, int rows) {
    is_whole = done == rows || goes_on();
    return is_whole;
  });
  return is_whole ? renderer::make_rgb8(rendering.samples) : std::vector<std::uint8_t>();
}

Columns<Rendering> speed_columns() {
  using R = Rendering;
  using base::empty_column;
  const auto time_per_ray_ms = [](const R& r) {
    return r.time_s / static_cast<double>(r.rays.total()) * 1e3;
  };
  return {column("time_s", &R::time_s, "time from the first task until the picture is complete"),
          column<R>("time_per_ray_ms", time_per_ray_ms, "time_s over rays"),
          empty_column<R>("speedup", "time_s with one worker over time_s"),
          empty_column<R>("efficiency", "speedup over workers"),
          empty_column<R>("serial_karp_flatt", "serial fraction by Karp and Flatt"),
          empty_column<R>("serial_gustafson", "serial fraction by Gustafson's law")};
}

Columns<Rendering> ray_columns() {
  using R = renderer::RayCounts;
  return base::lift_columns<Rendering>(
      Columns<R>{column<R>("rays", &R::total, "rays of all kinds, intersected with the scene"),
                 column("rays_primary", &R::primary, "rays from the eye"),
                 column("rays_reflected", &R::reflected, "rays reflected by a surface"),
                 column("rays_transmitted", &R::transmitted, "rays transmitted by a surface"),
                 column("rays_shadow", &R::shadow, "shadow feelers to the lights")},
      &Rendering::rays);
}

Columns<Rendering> time_columns() {
  using R = Rendering;
  return {
      column("order_to_pixel_s", &R::order_to_pixel_s,
             "longest time from an order with limits to the first pixel changed by a ray that it "
             "admitted"),
      column("setup_s", &R::setup_s,
             "time before time_s, in which the scene is distributed and the first rays are stored"),
      column<R>(
          "total_s", [](const R& r) { return r.setup_s + r.time_s; }, "setup_s plus time_s")};
}

Columns<Rendering> stage_columns() {
  using R = Rendering;
  return {
      {"stage{}_s", "time from the first task until the limits of a stage were reached",
       &stage_cells, true},
      column<R>(
          "aborted", [](const R& r) { return r.is_aborted ? 1 : 0; },
          "1 if the user ended the run before the picture was complete, else 0"),
      {"stage{}_lit", "share of non-black pixels in the key image of a stage", &lit_cells, true}};
}

Given make_given(const programs::Setup& setup, const SceneChoice& scene,
                 const renderer::Params& image, int max_cell, const Rendering& r) {
  Given given;
  auto& extras = given.extras;
  if (!r.growth.empty()) {
    auto grown = snapshots::make_quality_curve(r.growth, image.width, max_cell);
    extras.growth = std::move(grown.rows);
    given.growth = grown.figures;
  }
  extras.images = make_images(picture_name(scene), image, r);
  extras.end = r.end;
  extras.use = r.use;
  extras.events = r.events;
  extras.notes = r.notes;
  for (auto& note : note_models(r.use)) extras.notes.push_back(std::move(note));
  if (setup.cycles_per_host_s) {
    for (auto& note : kernels::note_short(r.kernels)) extras.notes.push_back(std::move(note));
    extras.kernels = r.kernels;
  }
  return given;
}

}  // namespace ray_tracing

// Takes two passes of samples in a given order of pixels. Records the quality of the picture and
// the length of the queue of quadrants. Simulates no machine, so the results contain no times.
#include "renderer/progressive/refinement.hpp"

#include <cmath>

#include "renderer/files/load_scene.hpp"
#include "renderer/quality/quality.hpp"
#include "simulator/programs/declare/program.hpp"

namespace programs {

namespace refinement {

using renderer::progressive::Order;
using renderer::progressive::QuadrantQueue;
using renderer::progressive::Refinement;

constexpr int PERCENTS[] = {1, 5, 10, 25, 50, 100};

struct Params {
  base::Source scene{"spheres:200", ""};
  renderer::Params image;
  Order order = Order::quadrants;
};

struct Measured {
  int percent = 0;
  std::uint64_t samples = 0, rays = 0;
  double sampled = 0;  // fraction of the pixels that have a sample
  std::optional<std::uint64_t> queue, queue_peak;
  double ssim = 0, rmse = 0;
};

std::pair<Measured, renderer::Samples> look_at(const Refinement& image, int percent) {
  const auto& counts = image.state().counts;
  const auto found = image.make_rendering();
  Measured row;
  row.percent = percent;
  row.samples = image.done();
  row.rays = found.rays.total();
  row.sampled = static_cast<double>(std::ranges::count_if(counts, [](int n) { return n > 0; })) /
                static_cast<double>(counts.size());
  if (const auto* queue = image.queue()) {
    row.queue = queue->length();
    row.queue_peak = queue->peak();
  }
  return {row, found.samples};
}

Outcome<Measured> run(const Setup&, const Params& params) {
  const auto& [text, path] = params.scene;
  const auto scene = renderer::load_scene(path.empty() ? text : path);
  Refinement image(scene, params.image, params.order);
  Outcome<Measured> outcome;
  std::vector<renderer::Bitmap> pictures;
  for (const int percent : PERCENTS) {
    const auto goal =
        static_cast<std::uint64_t>(std::ceil(percent / 100.0 * static_cast<double>(image.total())));
    while (image.done() < goal) image.advance(goal - image.done());
    auto [row, samples] = look_at(image, percent);
    pictures.push_back(make_bitmap(samples));
    outcome.rows.push_back(row);
    outcome.images.push_back(
        {.name = fmt::format("percent-{}", percent),
         .at_s = {},
         .save = [samples = std::move(samples)](
                     const std::string& file) { renderer::save_png(file, samples); },
         .is_named = true});
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    outcome.rows[i].ssim = renderer::ssim(pictures[i], pictures.back());
    outcome.rows[i].rmse = renderer::rmse(pictures[i], pictures.back());
  }
  return outcome;
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join<base::Field<Params>>(
      {D::source("scene", &Params::scene, "room:27, spheres:200, hills:20000 or an NFF file"),
       renderer::progressive::order_field<Params>(&Params::order)},
      {base::lift_all<Params>(renderer::param_fields(), &Params::image)});
}

base::Columns<Measured> make_columns() {
  using M = Measured;
  return {
      column("percent", &M::percent, "samples taken so far, in percent of all samples"),
      column("samples", &M::samples, "samples taken"),
      column("rays", &M::rays, "rays of the samples taken so far"),
      column("sampled", &M::sampled, "share of the pixels that have at least one sample"),
      column("queue", &M::queue, "quadrants in the queue; the second pass starts with a new queue"),
      column("queue_peak", &M::queue_peak, "largest number of quadrants in the queue in this pass"),
      column("ssim", &M::ssim, "structural similarity to the final picture; 1: equal"),
      column("rmse", &M::rmse,
             "root mean square difference from the final picture, in levels of 0 to 255")};
}

struct Size {
  int width = 512, height = 512;
};

struct Length {
  std::uint64_t pixels = 0, peak = 0;
};

Outcome<Length> measure_queue(const Setup&, const Size& size) {
  QuadrantQueue queue({0, 0, size.width, size.height});
  Length length;
  while (queue.next()) ++length.pixels;
  length.peak = queue.peak();
  return length;
}

}  // namespace refinement

Program make_refinement() {
  using namespace refinement;
  return make_program<Params, Measured>(
      {.name = "refinement",
       .help = "how a picture grows in two passes, of which the first takes one sample per pixel; "
               "nothing is simulated",
       .fields = make_fields(),
       .columns = make_columns(),
       .parts = {"percent"},
       .run = &run,
       .check = [](const Setup&, const Params& params) { renderer::check(params.image); }});
}

Program make_quadrants() {
  using namespace refinement;
  using D = base::Declare<Size>;
  return make_program<Size, Length>(
      {.name = "quadrants",
       .help = "computes the length of the queue of quadrants, without a simulated machine",
       .fields = {D::whole("width", &Size::width, 1, renderer::MAX_SIDE, "pixels",
                           "width of the image"),
                  D::whole("height", &Size::height, 1, renderer::MAX_SIDE, "pixels",
                           "height of the image")},
       .columns = {column("pixels", &Length::pixels,
                          "pixels of the image; each leaves the queue once"),
                   column("queue_peak", &Length::peak, "largest number of quadrants in the queue")},
       .run = &measure_queue});
}

}  // namespace programs

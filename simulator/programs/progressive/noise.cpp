// Noise of rays with random directions, as a function of the number of samples. Simulates no
// machine.
#include "renderer/files/load_scene.hpp"
#include "renderer/quality/quality.hpp"
#include "renderer/trace/render.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace noise {

struct Params {
  base::Source scene{"spheres:200", ""};
  renderer::Params image;
  int reference = 1024;
};

struct Measured {
  int samples = 0;
  renderer::RayCounts rays;
  double rmse = 0;
  std::optional<double> exponent, rays_share, rmse_share;
};

// Renders the image with `samples` samples per pixel. The seed depends on `samples`, so that two
// images with different numbers have independent noise.
renderer::Rendering render_with(const renderer::Scene& scene, renderer::Params image, int samples,
                                double adaptive = 0) {
  image.sampling.pixel_samples = samples;
  image.sampling.adaptive = adaptive;
  image.sampling.seed += static_cast<std::uint64_t>(samples);
  return renderer::render(scene, image);
}

// Compares images with a reference image, and adds a row of results for each.
class Rows {
 public:
  explicit Rows(renderer::Samples reference) : reference_(std::move(reference)) {}

  Measured& add(int samples, renderer::Rendering image, const std::string& name) {
    outcome.rows.push_back({.samples = samples,
                            .rays = image.rays,
                            .rmse = renderer::rms_difference(image.samples, reference_),
                            .exponent = {},
                            .rays_share = {},
                            .rmse_share = {}});
    outcome.images.push_back({.name = name,
                              .at_s = std::nullopt,
                              .save = [samples = std::move(image.samples)](const std::string& to) {
                                renderer::save_png(to, samples);
                              }});
    return outcome.rows.back();
  }

  Outcome<Measured> outcome;

 private:
  const renderer::Samples reference_;
};

double divide(std::uint64_t a, std::uint64_t b) {
  return static_cast<double>(a) / static_cast<double>(b);
}

Outcome<Measured> run(const Setup&, const Params& params) {
  const auto& [text, path] = params.scene;
  const auto scene = renderer::load_scene(path.empty() ? text : path);
  const auto& [most, adaptive] =
      std::tie(params.image.sampling.pixel_samples, params.image.sampling.adaptive);
  const auto render = [&](int samples, double error = 0) {
    return render_with(scene, params.image, samples, error);
  };
  const auto name = [](int samples) { return fmt::format("samples-{}", samples); };
  renderer::Params other = params.image;
  other.sampling.seed += renderer::MAX_PIXEL_SAMPLES;  // a seed that no other image uses
  Rows rows(render_with(scene, other, params.reference).samples);
  if (adaptive > 0) {
    using renderer::ADAPTIVE_SAMPLES;
    const Measured all =
        rows.add(ADAPTIVE_SAMPLES, render(ADAPTIVE_SAMPLES), name(ADAPTIVE_SAMPLES));
    Measured& found = rows.add(most, render(most, adaptive), "adaptive");
    found.rays_share = divide(found.rays.total(), all.rays.total());
    if (all.rmse > 0) found.rmse_share = found.rmse / all.rmse;
    return std::move(rows.outcome);
  }
  for (int samples = 1; samples <= most; samples *= 4) {
    Measured& row = rows.add(samples, render(samples), name(samples));
    const double before = samples > 1 ? (&row - 1)->rmse : 0;
    if (before > 0 && row.rmse > 0)
      // Rounded to float, so that the result does not depend on the library's logarithm.
      row.exponent = static_cast<float>(std::log(row.rmse / before) / std::log(4.0));
  }
  return std::move(rows.outcome);
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join<base::Field<Params>>(
      {D::source("scene", &Params::scene, "room:27, spheres:200, hills:20000 or an NFF file"),
       D::whole("reference", &Params::reference, 1, renderer::MAX_PIXEL_SAMPLES, "",
                "samples per pixel of the reference image")},
      {base::lift_all<Params>(renderer::param_fields(), &Params::image)});
}

base::Columns<Measured> make_columns() {
  return {column("samples", &Measured::samples,
                 "samples per pixel: 1, 4, 16 ... pixel_samples; with adaptive, 64 for all pixels "
                 "and at most pixel_samples"),
          column<Measured>(
              "rays", [](const Measured& m) { return m.rays.total(); }, "rays of all kinds"),
          column("rmse", &Measured::rmse,
                 "root mean square of the differences from the reference; components are 0 to 1"),
          column("exponent", &Measured::exponent,
                 "exponent of the number of samples in rmse since the previous row; -0.5 for "
                 "random samples"),
          column("rays_share", &Measured::rays_share,
                 "rays with adaptive samples over those with 64 samples for all pixels"),
          column("rmse_share", &Measured::rmse_share,
                 "rmse with adaptive samples over that with 64 samples for all pixels")};
}

void check_program(const Setup&, const Params& params) { check(params.image); }

}  // namespace noise

Program make_noise() {
  using namespace noise;
  return make_program<Params, Measured>(
      {.name = "noise",
       .help = "noise of distributed rays for increasing numbers of samples; nothing is simulated",
       .fields = make_fields(),
       .columns = make_columns(),
       .parts = {"samples"},
       .run = &run,
       .check = &check_program});
}

}  // namespace programs

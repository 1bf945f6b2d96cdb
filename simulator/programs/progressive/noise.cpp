// How the noise of distributed rays falls with the number of samples, without a machine.
#include "renderer/files/nff.hpp"
#include "renderer/quality/quality.hpp"
#include "renderer/trace/render.hpp"
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

struct Params {
  base::Source scene{"spheres:200", ""};
  renderer::Params image;
  int reference = 1024;
};

struct Measured {
  int samples = 0;
  renderer::RayCounts rays;
  double rmse = 0;
  std::optional<double> exponent;
};

// The image of so many samples a pixel, of random numbers of their own.
renderer::Rendering render_with(const renderer::Scene& scene, renderer::Params image, int samples) {
  image.sampling.pixel_samples = samples;
  image.sampling.seed += static_cast<std::uint64_t>(samples);
  return renderer::render(scene, image);
}

Outcome<Measured> run(const Setup&, const Params& params) {
  const auto& [text, path] = params.scene;
  const auto scene = renderer::load_scene(path.empty() ? text : path);
  const auto reference = render_with(scene, params.image, params.reference);
  Outcome<Measured> outcome;
  for (int samples = 1; samples <= params.image.sampling.pixel_samples; samples *= 4) {
    const auto image = render_with(scene, params.image, samples);
    Measured row{samples, image.rays, renderer::rms_difference(image.samples, reference.samples),
                 std::nullopt};
    if (!outcome.rows.empty() && row.rmse > 0)
      // Rounded, so that it is the same whichever library computes the logarithm.
      row.exponent =
          static_cast<float>(std::log(row.rmse / outcome.rows.back().rmse) / std::log(4.0));
    outcome.rows.push_back(row);
    outcome.images.push_back({.name = fmt::format("samples-{}", samples),
                              .at_s = std::nullopt,
                              .save = [samples = image.samples](const std::string& to) {
                                renderer::save_png(to, samples);
                              }});
  }
  return outcome;
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join<base::Field<Params>>(
      {D::source("scene", &Params::scene, "room:27, spheres:200, hills:20000 or an NFF file"),
       D::whole("reference", &Params::reference, 1, renderer::MAX_PIXEL_SAMPLES, "",
                "samples of a pixel of the image that the others are compared with")},
      {base::lift_all<Params>(renderer::param_fields(), &Params::image)});
}

base::Columns<Measured> make_columns() {
  return {column("samples", &Measured::samples, "samples of a pixel: 1, 4, 16 ... pixel_samples"),
          column<Measured>(
              "rays", [](const Measured& m) { return m.rays.total(); }, "rays of all kinds"),
          column("rmse", &Measured::rmse,
                 "root mean square of the differences from the reference, components from 0 to 1"),
          column("exponent", &Measured::exponent,
                 "power of the number of samples with which rmse has grown since the row before: "
                 "-0.5 for random samples")};
}

void check_program(const Setup&, const Params& params) {
  check(params.image);
  if (params.image.sampling.adaptive > 0)
    base::refuse("adaptive", "found {}, expected 0: every pixel has as many samples",
                 params.image.sampling.adaptive);
}

}  // namespace

Program make_noise() {
  return make_program<Params, Measured>(
      {.name = "noise",
       .help = "the noise of distributed rays against the number of samples, without a machine",
       .fields = make_fields(),
       .columns = make_columns(),
       .parts = {"samples"},
       .run = &run,
       .check = &check_program});
}

}  // namespace programs

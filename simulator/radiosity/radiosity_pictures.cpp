// The pictures of a run of radiosity, and of what it is compared with.
#include <fmt/format.h>

#include <memory>

#include "simulator/radiosity/compare_pictures.hpp"
#include "simulator/radiosity/program.hpp"

namespace programs {

namespace {

using radiosity::Display;
using radiosity::Picture;

Image make_image(const std::string& name, Picture picture, const Display& display,
                 std::optional<double> at_s = {}) {
  const auto kept = std::make_shared<const Picture>(std::move(picture));
  Image image{name, at_s,
              [kept, display](const std::string& path) { save_png(path, *kept, display); }};
  return image;
}

// With the file of all its range.
Image make_last_image(const std::string& name, const Picture& picture, const Display& display) {
  auto image = make_image(name, picture, display);
  image.save_exr = [kept = std::make_shared<const Picture>(picture)](const std::string& path) {
    save_exr(path, *kept);
  };
  return image;
}

// What figures 3.16 (c) and 3.18 (c) show: the difference of what is displayed.
Image make_difference_image(const Setup& setup, const Picture& picture, const Picture& reference,
                            const Display& display) {
  return make_image("difference",
                    make_difference(make_displayed(picture, display),
                                    make_displayed(reference, display), setup["amplify"]),
                    {1, 1});
}

void add_errors(Row& row, const PictureError& error) {
  row.insert(row.end(), {{"image_error", error.image},
                         {"line_error", error.line},
                         {"peak_error", error.line_peak},
                         {"line_error_linear", error.line_linear},
                         {"peak_error_linear", error.line_peak_linear},
                         {"peak_shift", error.peak_shift}});
}

}  // namespace

void add_pictures(const Setup& setup, MeshedRoom meshed, const std::vector<amp::Frame>& frames,
                  Rows& rows) {
  const auto reconstruction = reconstruction_params(setup, "reconstruction");
  const Camera camera(setup, meshed.room);
  LitRoom lit{std::move(meshed), {}};
  const auto light = [&](const amp::Frame& frame) {
    return light_vertices(setup, lit.room.mesh, frame.vertices, frame.ambient);
  };
  lit.vertices = light(frames.back());
  const auto picture = camera.take(lit, reconstruction);
  auto emitters = camera.find_emitters(lit.room.mesh);
  std::optional<Picture> reference;
  const auto known = solve_reference(setup);
  const auto& other = known ? known->room.mesh : lit.room.mesh;
  auto& row = rows.rows[0];
  row.emplace_back("radiosity_mean", mean_radiosity(lit.room.mesh, lit.vertices, other));
  if (known) {
    row.emplace_back("reference_mean", mean_radiosity(other, known->vertices, lit.room.mesh));
    reference = camera.take(*known, reconstruction_params(setup, "reference_reconstruction"));
    const auto others = camera.find_emitters(known->room.mesh);
    for (std::size_t i = 0; i < emitters.size(); ++i) emitters[i] = emitters[i] || others[i];
  }
  const auto display = make_display(setup, reference ? *reference : picture, emitters);
  row.emplace_back("exposure_used", display.exposure);
  for (const auto& frame : frames)
    if (&frame != &frames.back())
      rows.images.push_back(make_image(fmt::format("{}-shots", frame.shots),
                                       camera.preview(lit.room.mesh, light(frame), reconstruction),
                                       display, frame.at_s));
  rows.images.push_back(make_last_image("picture", picture, display));
  if (!reference) return;
  rows.images.push_back(make_last_image("reference", *reference, display));
  rows.images.push_back(make_difference_image(setup, picture, *reference, display));
  add_errors(
      row, compare_pictures(picture, *reference, display,
                            {emitters, picture.height / 2, setup["peak_from"], setup["peak_to"]}));
}

}  // namespace programs

#include "simulator/parallel_radiosity/pictures.hpp"

namespace parallel_radiosity {

using programs::Image;
using radiosity::Display;
using radiosity::LitRoom;
using radiosity::Picture;

namespace {

Image make_image(const std::string& name, Picture picture, const Display& display,
                 std::optional<double> at_s = {}) {
  const auto kept = std::make_shared<const Picture>(std::move(picture));
  return {name, at_s, [kept, display](const std::string& path) { save_png(path, *kept, display); }};
}

// Makes an image that can also be saved as EXR, with colours that are not clipped.
Image make_last_image(const std::string& name, const Picture& picture, const Display& display) {
  auto image = make_image(name, picture, display);
  image.save_exr = [picture](const std::string& path) { save_exr(path, picture); };
  return image;
}

std::vector<radiosity::Rgb> light_of(const ProgramParams& params, const radiosity::Mesh& mesh,
                                     const Frame& frame) {
  auto vertices = frame.vertices;
  if (params.room.light.ambient) add_ambient(mesh, frame.ambient, vertices);
  return vertices;
}

// If there are several frames, adds images of all frames except the last, and previews of all
// frames.
void add_previews(const ProgramParams& params, const renderer::View& view,
                  const radiosity::Mesh& mesh, const std::vector<Frame>& frames,
                  const Display& display, Pictures& shown) {
  if (frames.size() < 2) return;
  for (const auto& frame : frames) {
    const auto picture = draw(params, view, mesh, frame);
    shown.previews.push_back({.at_s = frame.at_s, .rgb8 = make_rgb8(picture, display)});
    if (&frame != &frames.back())
      shown.images.push_back(
          make_image(fmt::format("{}-shots", frame.shots), picture, display, frame.at_s));
  }
}

}  // namespace

Picture draw(const ProgramParams& params, const renderer::View& view, const radiosity::Mesh& mesh,
             const Frame& frame) {
  const auto light = reconstruct(mesh, light_of(params, mesh, frame), params.room.reconstruction);
  return preview_picture(mesh, light, view, params.room.picture);
}

renderer::Bitmap look(const ProgramParams& params, const renderer::View& view,
                      const radiosity::Mesh& mesh, const Frame* frame) {
  const auto size = radiosity::fit(params.room.picture, view);
  if (!frame)
    return {size.width, size.height,
            std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size.width) *
                                      static_cast<std::size_t>(size.height))};
  const auto picture = draw(params, view, mesh, *frame);
  const auto display =
      fit(params.room.display, picture, find_emitters(params.room, view, mesh, mesh));
  return {picture.width, picture.height, make_rgb8(picture, display)};
}

Pictures show(const ProgramParams& params, const renderer::View& view, const radiosity::Mesh& mesh,
              const std::vector<Frame>& frames) {
  const auto& room = params.room;
  const LitRoom lit{mesh, light_of(params, mesh, frames.back())};
  const auto picture = trace_picture(lit, room.reconstruction, view, room.picture);
  const auto known = solve_reference(room);
  const LitRoom& other = known ? *known : lit;
  const auto reference = known ? trace_reference(room, *known, view) : picture;
  const auto emitters = find_emitters(room, view, mesh, other.mesh);
  const auto display = fit(room.display, reference, emitters);
  Pictures shown{
      {eval_mean_radiosity(lit, other.mesh), display.exposure, 0, {}}, {}, {}, picture.width};
  add_previews(params, view, mesh, frames, display, shown);
  shown.images.push_back(make_last_image("picture", picture, display));
  if (!known) return shown;
  shown.images.push_back(make_last_image("reference", reference, display));
  auto difference = make_difference(make_displayed(picture, display),
                                    make_displayed(reference, display), params.amplify);
  shown.images.push_back(make_image("difference", std::move(difference), {1, 1}));
  shown.summary.reference_mean = eval_mean_radiosity(*known, mesh);
  shown.summary.error =
      compare_pictures(picture, reference, display,
                       {emitters, picture.height / 2, params.peak_from, params.peak_to});
  return shown;
}

}  // namespace parallel_radiosity

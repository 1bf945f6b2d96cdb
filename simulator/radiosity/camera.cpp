// Pictures of rooms.
#include <algorithm>

#include "simulator/radiosity/rooms.hpp"

namespace programs {

using radiosity::Picture;
using radiosity::Reconstruction;
using radiosity::Rgb;

std::vector<Parameter> view_parameters() {
  return {make_choice("twist", {"estimated", "diagonal", "zero"},
                      "the mixed derivatives of bicubic surfaces"),
          make_choice("ambient", {"added", "left-out"}, "what the unsent light will yet give"),
          {"width", 0, 0, 65536, true, "of pictures; pixels; 0: the room's"},
          {"height", 0, 0, 65536, true, "of pictures; pixels; 0: the room's"},
          {"pixel_samples", 1, 1, 64, true, "rays a pixel along and across"},
          {"exposure", 0, 0, 1e9, false,
           "a pixel is 255 * min(1, exposure * radiosity) ^ (1 / gamma); 0: such that 1 % of what "
           "does not emit is cut off, in the reference if there is one"},
          {"gamma", 2.2, 0.1, 10, false, "see exposure"}};
}

std::vector<Parameter> reference_parameters() {
  return {make_path("reference", "a room to compare with; none: the scene itself"),
          {"reference_refine", 0, 0, 1000, true,
           "its `refine`; 0: the scene's if a reference is named, else nothing is compared"},
          {"reference_senders", 0, 0, 1000, true,
           "the `refine` of the patches that send its light to the vertices of the finer ones; 0: "
           "all of its patches send"},
          make_choice("reference_reconstruction", {"bilinear", "bicubic", "flat"},
                      "how its illumination is interpolated")};
}

radiosity::ReconstructionParams reconstruction_params(const Setup& setup, std::string_view name) {
  static constexpr radiosity::Twist TWISTS[] = {radiosity::Twist::estimated,
                                                radiosity::Twist::diagonal, radiosity::Twist::zero};
  static constexpr Reconstruction KINDS[] = {Reconstruction::bilinear, Reconstruction::bicubic,
                                             Reconstruction::flat};
  return {KINDS[setup.whole(name)], TWISTS[setup.whole("twist")]};
}

Camera::Camera(const Setup& setup, const radiosity::Room& scene) : view_(scene.view) {
  const auto or_view = [&](const char* name, int of_view) {
    const auto asked = static_cast<int>(setup.whole(name));
    return asked > 0 ? asked : of_view;
  };
  params_.width = or_view("width", view_.width);
  params_.height = or_view("height", view_.height);
  params_.samples = static_cast<int>(setup.whole("pixel_samples"));
}

Picture Camera::take(const LitRoom& lit, const radiosity::ReconstructionParams& params) const {
  renderer::Work ignored;
  return trace_picture(lit.room.mesh, reconstruct(lit.room.mesh, lit.vertices, params), view_,
                       params_, ignored);
}

Picture Camera::preview(const radiosity::Mesh& mesh, const std::vector<Rgb>& vertices,
                        const radiosity::ReconstructionParams& params) const {
  return preview_picture(mesh, reconstruct(mesh, vertices, params), view_, params_);
}

std::vector<bool> Camera::find_emitters(const radiosity::Mesh& mesh) const {
  std::vector<Rgb> emission;
  for (const auto& vertex : mesh.vertices)
    emission.push_back(mesh.materials[vertex.material].emission);
  renderer::Work ignored;
  const auto picture = trace_picture(mesh, reconstruct(mesh, emission, {Reconstruction::flat, {}}),
                                     view_, params_, ignored);
  std::vector<bool> emitters;
  for (const auto& pixel : picture.pixels)
    emitters.push_back(pixel.r > 0 || pixel.g > 0 || pixel.b > 0);
  return emitters;
}

radiosity::Display make_display(const Setup& setup, const Picture& picture,
                                const std::vector<bool>& emitters) {
  radiosity::Display display{setup["exposure"], setup["gamma"]};
  if (display.exposure > 0) return display;
  Picture dark;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (!emitters[i]) dark.pixels.push_back(picture.pixels[i]);
  dark.width = static_cast<int>(dark.pixels.size());
  dark.height = 1;
  display.exposure = find_exposure(dark.pixels.empty() ? picture : dark);
  return display;
}

}  // namespace programs

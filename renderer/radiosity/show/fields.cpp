#include "renderer/radiosity/show/fields.hpp"

namespace radiosity {

base::Fields<ReconstructionParams> reconstruction_fields() {
  using D = base::Declare<ReconstructionParams>;
  static const base::Names<Reconstruction> KINDS = {{"bilinear", Reconstruction::bilinear},
                                                    {"bicubic", Reconstruction::bicubic},
                                                    {"flat", Reconstruction::flat}};
  static const base::Names<Twist> TWISTS = {
      {"estimated", Twist::estimated}, {"diagonal", Twist::diagonal}, {"zero", Twist::zero}};
  return {D::choice("reconstruction", &ReconstructionParams::kind, KINDS,
                    "how illumination is interpolated between vertices"),
          D::choice("twist", &ReconstructionParams::twist, TWISTS,
                    "the mixed derivatives of bicubic surfaces")};
}

base::Fields<PictureParams> picture_fields() {
  using D = base::Declare<PictureParams>;
  return {D::whole("width", &PictureParams::width, 0, 65536, "pixels",
                   "width of pictures; 0: the room's"),
          D::whole("height", &PictureParams::height, 0, 65536, "pixels",
                   "height of pictures; 0: the room's"),
          D::whole("pixel_samples", &PictureParams::samples, 1, 64, "",
                   "rays of a pixel, along and across"),
          D::whole("depth", &PictureParams::depth, 0, 1000, "",
                   "mirrors that a ray from the eye may meet")};
}

base::Fields<Display> display_fields() {
  using D = base::Declare<Display>;
  return {D::number("exposure", &Display::exposure, 0, 1e9, "",
                    "a pixel is 255 * min(1, exposure * radiosity) ^ (1 / gamma); 0: such that 1 % "
                    "of what does not emit is cut off, in the reference if there is one"),
          D::number("gamma", &Display::gamma, 0.1, 10, "",
                    "exponent of a pixel's value: see exposure")};
}

}  // namespace radiosity

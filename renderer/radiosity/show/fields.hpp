#pragma once
// The parameters of a room's picture, declared once for experiment files and the command line.
#include "base/fields.hpp"
#include "renderer/radiosity/show/display.hpp"

namespace radiosity {

/// reconstruction, twist.
base::Fields<ReconstructionParams> reconstruction_fields();
/// width, height, pixel_samples, depth.
base::Fields<PictureParams> picture_fields();
/// exposure, gamma.
base::Fields<Display> display_fields();

}  // namespace radiosity

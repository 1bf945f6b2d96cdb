#pragma once
// The pictures of a run of radiosity, and how they compare with a reference.
#include "renderer/radiosity/show/compare_pictures.hpp"
#include "simulator/growth/recorder.hpp"
#include "simulator/radiosity/program.hpp"

namespace amp {

/// What the last picture tells.
struct PictureSummary {
  double radiosity_mean = 0;  ///< over the patches of materials that the reference has too
  double exposure = 0;        ///< > 0
  double reference_mean = 0;  ///< where there is a reference
  std::optional<radiosity::PictureError> error;  ///< the same
};

/// The picture of a frame on the way: its light reconstructed, and drawn with a z-buffer.
radiosity::Picture draw(const ProgramParams& params, const renderer::View& view,
                        const radiosity::Mesh& mesh, const Frame& frame);

/// The same as it is displayed, exposed for itself; black without a frame.
renderer::Bitmap look(const ProgramParams& params, const renderer::View& view,
                      const radiosity::Mesh& mesh, const Frame* frame);

/// What a run shows.
struct Pictures {
  PictureSummary summary;
  std::vector<programs::Image> images;
  std::vector<growth::Shown> previews;  ///< of all frames, as the display has drawn them
  int width = 0;                        ///< pixels
};

/// Pictures "N-shots" of all frames but the last, "picture", and with a reference "reference" and
/// "difference": figures 3.16 (c) and 3.18 (c) show the difference of what is displayed.
Pictures show(const ProgramParams& params, const renderer::View& view, const radiosity::Mesh& mesh,
              const std::vector<Frame>& frames);

}  // namespace amp

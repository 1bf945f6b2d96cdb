#pragma once
// Pictures of a radiosity run, and their comparison with a reference.
#include "renderer/radiosity/show/compare_pictures.hpp"
#include "simulator/parallel_radiosity/program.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace parallel_radiosity {

/// Measurements of the final picture.
struct PictureSummary {
  double radiosity_mean = 0;  ///< over patches whose material also exists in the reference
  double exposure = 0;        ///< greater than 0
  double reference_mean = 0;  ///< set only with a reference
  std::optional<radiosity::PictureError> error;  ///< set only with a reference
};

/// Draws an intermediate frame with reconstructed light and a z-buffer.
radiosity::Picture draw(const ProgramParams& params, const renderer::View& view,
                        const radiosity::Mesh& mesh, const Frame& frame);

/// Draws a frame as displayed, with its own exposure; black if `frame` is null.
renderer::Bitmap look(const ProgramParams& params, const renderer::View& view,
                      const radiosity::Mesh& mesh, const Frame* frame);

/// Pictures and measurements of a run.
struct Pictures {
  PictureSummary summary;
  std::vector<programs::Image> images;
  std::vector<snapshots::Snapshot> previews;  ///< all frames as drawn by the display
  int width = 0;                              ///< in pixels
};

/// Makes the pictures "N-shots" of all frames except the last, and "picture" of the last one. With
/// a reference, also makes "reference" and "difference". The difference is that of displayed
/// values, as in figures 3.16 (c) and 3.18 (c).
Pictures show(const ProgramParams& params, const renderer::View& view, const radiosity::Mesh& mesh,
              const std::vector<Frame>& frames);

}  // namespace parallel_radiosity

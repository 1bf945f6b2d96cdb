#pragma once
// Pictures of a radiosity run, and their comparison with a reference solution.
#include "renderer/radiosity/show/compare_pictures.hpp"
#include "simulator/parallel_radiosity/program.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace parallel_radiosity {

/// Measurements of the final picture.
struct PictureSummary {
  /// Mean radiosity over the patches whose material also exists in the reference.
  double radiosity_mean = 0;
  double exposure = 0;        ///< factor on the picture's brightness for display; greater than 0
  double reference_mean = 0;  ///< mean radiosity of the reference; 0 without a reference
  /// Difference from the reference's picture; only with a reference.
  std::optional<radiosity::PictureError> error;
};

/// Draws an intermediate frame with a z-buffer. The light within patches is interpolated.
radiosity::Picture draw(const ProgramParams& params, const renderer::View& view,
                        const radiosity::Mesh& mesh, const Frame& frame);

/// Draws a frame as it is displayed, with an exposure of its own. Black if `frame` is null.
renderer::Bitmap look(const ProgramParams& params, const renderer::View& view,
                      const radiosity::Mesh& mesh, const Frame* frame);

/// Pictures and measurements of a run.
struct Pictures {
  PictureSummary summary;
  std::vector<programs::Image> images;
  std::vector<snapshots::Snapshot> previews;  ///< every frame as the display draws it
  int width = 0;                              ///< width of the previews in pixels
};

/// Makes a picture "N-shots" of each frame except the last, and "picture" of the last one. With a
/// reference, also makes "reference" and "difference". The difference is that of displayed values
/// (0 to 255), as in figures 3.16 (c) and 3.18 (c) of the thesis.
Pictures show(const ProgramParams& params, const renderer::View& view, const radiosity::Mesh& mesh,
              const std::vector<Frame>& frames);

}  // namespace parallel_radiosity

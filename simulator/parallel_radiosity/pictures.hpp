#pragma once
// Pictures of a radiosity run, and their comparison with a reference.
#include "renderer/radiosity/show/compare_pictures.hpp"
#include "simulator/parallel_radiosity/program.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace parallel_radiosity {

/// Measurements of the last picture.
struct PictureSummary {
  double radiosity_mean = 0;  ///< over patches of materials that the reference also has
  double exposure = 0;        ///< > 0
  double reference_mean = 0;  ///< if there is a reference
  std::optional<radiosity::PictureError> error;  ///< if there is a reference
};

/// Picture of an intermediate frame: light reconstructed, drawn with a z-buffer.
radiosity::Picture draw(const ProgramParams& params, const renderer::View& view,
                        const radiosity::Mesh& mesh, const Frame& frame);

/// The same picture as displayed, with its own exposure; black without a frame.
renderer::Bitmap look(const ProgramParams& params, const renderer::View& view,
                      const radiosity::Mesh& mesh, const Frame* frame);

/// Pictures and measurements of a run.
struct Pictures {
  PictureSummary summary;
  std::vector<programs::Image> images;
  std::vector<snapshots::Snapshot> previews;  ///< of all frames, as drawn by the display
  int width = 0;                              ///< pixels
};

/// Pictures "N-shots" of all frames but the last, and "picture"; with a reference also "reference"
/// and "difference". Figures 3.16 (c) and 3.18 (c) show the difference of displayed values.
Pictures show(const ProgramParams& params, const renderer::View& view, const radiosity::Mesh& mesh,
              const std::vector<Frame>& frames);

}  // namespace parallel_radiosity

#pragma once
// Reference pictures for radiosity by an unbiased path tracer (J. Kajiya, "The Rendering Equation",
// SIGGRAPH 1986), on Embree. It shares with the kernel the room and the rays from the eye, but no
// calculation of light.

#include "renderer/radiosity/show/picture.hpp"
#include "renderer/trace/shade.hpp"

namespace radiosity::reference {

/// Parameters of the path tracer. Paths of a pixel are taken in rounds of equal numbers, each with
/// its own randomised low-discrepancy set. The standard error follows from the spread of the
/// rounds' means. Errors of nearby pixels are correlated, since these share paths.
struct TracerParams {
  int width = 0, height = 0;  ///< size of the picture in pixels; 0: that of the view
  int samples = 256;          ///< paths per pixel, in whole rounds, at least one in each
  int rounds = 8;             ///< number of rounds, at least 2
  int depth = 8;              ///< limit on the mirrors that a ray from the eye may meet
  int threads = 0;            ///< 0: as many as the host has; results do not depend on it
  std::uint64_t seed = 1;
};

/// Result of trace_paths(). Rows run from the top, with pixels at y * width + x.
struct Reference {
  Picture picture;            ///< linear radiosity at the centres of pixels, as in trace_picture()
  std::vector<double> error;  ///< standard error of the mean of a pixel's components
  std::vector<bool> emits;    ///< whether the pixel shows an emitter
  /// Number of the visible face, equal for the same face seen over the same mirrors; 0: nothing.
  std::vector<std::uint32_t> faces;
};

/// Parameters for renderer::make_primary() of the rays from the eye: one through each pixel's
/// centre.
renderer::Params make_pixels(int width, int height);

/// Computes the reference picture. Faces are flat: normals at corners have no effect. Backs are
/// black and block light. Two faces that lie back to back show their fronts. The room must pass
/// check(). Throws BadInput as trace_picture() does, and std::runtime_error if Embree fails.
Reference trace_paths(const Room& room, const TracerParams& params);

}  // namespace radiosity::reference

#pragma once
// The reference for pictures of radiosity: an unbiased path tracer (J. Kajiya, "The Rendering
// Equation", SIGGRAPH 1986), on Embree. It shares the room and the rays from the eye with the
// kernel, but none of the light calculation.

#include "renderer/radiosity/show/picture.hpp"
#include "renderer/trace/shade.hpp"

namespace radiosity::reference {

/// Paths of a pixel are taken in rounds of equal numbers, each with its own randomised
/// low-discrepancy set. The spread of the rounds' means gives the standard error. Errors of nearby
/// pixels are correlated, since these share paths.
struct TracerParams {
  int width = 0, height = 0;  ///< pixels; 0: the view's
  int samples = 256;          ///< paths a pixel, in whole rounds, at least one each
  int rounds = 8;             ///< 2 or more
  int depth = 8;              ///< largest number of mirrors that a ray from the eye may meet
  int threads = 0;            ///< 0: as many as the host has; results do not depend on it
  std::uint64_t seed = 1;
};

/// Result of trace_paths(); rows run from the top, pixels at y * width + x.
struct Reference {
  Picture picture;            ///< radiosity at the pixels' centres, linear, like trace_picture()'s
  std::vector<double> error;  ///< standard error of the mean of a pixel's components
  std::vector<bool> emits;    ///< whether the pixel shows an emitter
  std::vector<std::uint32_t> faces;  ///< number of the visible face: equal for the same face
                                     ///< seen over the same mirrors; 0: nothing
};

/// The rays from the eye, for renderer::make_primary(): one through each pixel's centre.
renderer::Params make_pixels(int width, int height);

/// Faces are flat (corner normals have no effect); backs are black and block light. Two faces that
/// lie back to back show their fronts. The room must pass check(). Throws BadInput like
/// trace_picture(), and std::runtime_error if Embree fails.
Reference trace_paths(const Room& room, const TracerParams& params);

}  // namespace radiosity::reference

#pragma once
// Reference pictures for radiosity, by an unbiased path tracer (J. Kajiya, "The Rendering
// Equation", SIGGRAPH 1986) with Embree. It uses the same rooms and the same rays from the eye as
// the program under test, but no calculation of light.

#include "renderer/radiosity/show/picture.hpp"
#include "renderer/trace/shade.hpp"

namespace radiosity::reference {

/// Parameters of the path tracer. The paths of a pixel are traced in several rounds with equal
/// numbers of paths. Each round has its own random shift of a low-discrepancy set. The standard
/// error follows from the differences between rounds. Errors of nearby pixels are correlated,
/// because these pixels share paths.
struct TracerParams {
  int width = 0, height = 0;  ///< size of the picture in pixels; 0: the size of the view
  /// number of paths per pixel; rounded to whole rounds with at least one path each
  int samples = 256;
  int rounds = 8;  ///< number of rounds, at least 2
  int depth = 8;   ///< limit on the number of mirrors that a ray from the eye may meet
  /// number of threads, on which results do not depend; 0: as many as the host has
  int threads = 0;
  std::uint64_t seed = 1;
};

/// Result of trace_paths(). The pixel (x, y), with rows from the top, has the index y * width + x.
struct Reference {
  /// linear radiosity in the middle of each pixel, as in trace_picture()
  Picture picture;
  std::vector<double> error;  ///< standard error of the mean of a pixel's colour components
  std::vector<bool> emits;    ///< for each pixel: true if it shows an emitter
  /// For each pixel, the number of the visible face; 0: nothing is visible. A face that is seen via
  /// different mirrors has different numbers.
  std::vector<std::uint32_t> faces;
};

/// Parameters with which renderer::make_primary() makes the rays from the eye: one through the
/// middle of each pixel.
renderer::Params make_pixels(int width, int height);

/// Computes the reference picture. Faces are flat: normals at their corners have no effect. The
/// backs of faces are black and block light. If two faces lie back to back, both fronts are
/// visible. The room must pass check(). Throws BadInput as trace_picture() does, and
/// std::runtime_error if Embree fails.
Reference trace_paths(const Room& room, const TracerParams& params);

}  // namespace radiosity::reference

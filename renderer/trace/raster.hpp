#pragma once
// Positions of an image's samples in the view.

#include "renderer/trace/params.hpp"

namespace renderer {

/// The grid of samples. The sample of pixel (x, y), with y downwards, lies in the direction ahead +
/// (x - left) * step * right + (top - y) * step * above.
struct Raster {
  double left = 0, top = 0;  ///< distance in pixels from the first sample to the middle of the view
  double step = 0;  ///< distance between samples in the image plane, which is at distance 1
};

inline Raster make_raster(const View& view, const Params& p) {
  // Number of steps across the view: one per pixel. A lattice has samples on both edges, and
  // therefore one step fewer.
  const bool lattice = p.sample == SamplePosition::lattice;
  const double columns = lattice ? p.width - 1 : p.width, rows = lattice ? p.height - 1 : p.height;
  const double shift = p.sample == SamplePosition::center ? 0.5 : 0;
  return {columns / 2 - shift, rows / 2 - shift, 2 * view.half_height / std::max(rows, 1.0)};
}

}  // namespace renderer

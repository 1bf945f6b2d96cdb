#pragma once
// The order of computing the pixels of an image: the key image.order.
#include "base/fields.hpp"

namespace ray_tracing {

enum class PixelOrder : std::uint8_t {
  cells,     ///< the program's own order of image cells
  scan,      ///< row by row
  quadrants  ///< order of a queue of quadrants, see renderer::progressive::QuadrantQueue
};

template <class P>
base::Field<P> pixel_order_field(PixelOrder P::*member) {
  static const base::Names<PixelOrder> ORDERS = {{"cells", PixelOrder::cells},
                                                 {"scan", PixelOrder::scan},
                                                 {"quadrants", PixelOrder::quadrants}};
  return base::Declare<P>::choice(
      "order", member, ORDERS,
      "order of the pixels: cells (the program's own order), scan (row by row), or quadrants "
      "(progressive refinement by a queue of quadrants)");
}

}  // namespace ray_tracing

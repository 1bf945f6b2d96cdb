#pragma once
// The order in which the pixels of an image are begun, image.order.
#include "base/fields.hpp"

namespace tracing {

enum class PixelOrder : std::uint8_t {
  cells,     ///< as the program orders its image cells
  scan,      ///< one after the other, row by row
  quadrants  ///< as the queue of quadrants has them, see renderer::progressive::QuadrantQueue
};

template <class P>
base::Field<P> pixel_order_field(PixelOrder P::*member) {
  static const base::Names<PixelOrder> ORDERS = {{"cells", PixelOrder::cells},
                                                 {"scan", PixelOrder::scan},
                                                 {"quadrants", PixelOrder::quadrants}};
  return base::Declare<P>::choice(
      "order", member, ORDERS,
      "order of the pixels: cells (of the program's own order), scan (row by row), or quadrants "
      "(a queue of quadrants, each divided into four)");
}

}  // namespace tracing

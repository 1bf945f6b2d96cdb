#pragma once
// A worker's virtual frame buffers (thesis, 5.3): painted image cells that still have to be sent to
// the display.
#include <deque>

#include "simulator/iirra/shared.hpp"

namespace iirra {

class FrameBuffers {
 public:
  explicit FrameBuffers(Shared& shared) : shared_(shared) {}

  /// Paints a cell from the colours of its samples. A previous painting of the cell, if still
  /// unsent, is replaced. Charges time and allocates memory on the processor of this_process().
  void paint(TaskCell& cell, const SampleTable& samples, int order);
  /// Removes and returns the oldest blocks, as many as fit into one message.
  Picture take();
  bool empty() const { return blocks_.empty(); }

 private:
  Shared& shared_;
  std::deque<Painted> blocks_;
};

}  // namespace iirra

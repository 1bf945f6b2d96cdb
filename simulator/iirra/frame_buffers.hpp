#pragma once
// A worker's virtual frame buffers (thesis, 5.3): painted cells not yet sent to the display.
#include <deque>

#include "simulator/iirra/shared.hpp"

namespace iirra {

class FrameBuffers {
 public:
  explicit FrameBuffers(Shared& shared) : shared_(shared) {}

  /// Paints a cell from the colours of its samples and replaces its last painting. Charges time and
  /// memory to this_process()'s processor.
  void paint(TaskCell& cell, const SampleTable& samples, int order);
  /// Removes and returns the oldest blocks that fit into one message.
  Picture take();
  bool empty() const { return blocks_.empty(); }

 private:
  Shared& shared_;
  std::deque<Painted> blocks_;
};

}  // namespace iirra

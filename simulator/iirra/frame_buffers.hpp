#pragma once
// A worker's virtual frame buffers (thesis, 5.3): what it has painted of its cells, until the
// display has it.
#include <deque>

#include "simulator/iirra/shared.hpp"

namespace iirra {

class FrameBuffers {
 public:
  explicit FrameBuffers(Shared& shared) : shared_(shared) {}

  /// Paints a cell between the colours of its samples, in place of what it was, in the memory of
  /// this_process()'s processor and at its cost.
  void paint(TaskCell& cell, const SampleTable& samples, int order);
  /// As much as a message holds, the oldest first.
  Picture take();
  bool empty() const { return blocks_.empty(); }

 private:
  Shared& shared_;
  std::deque<Painted> blocks_;
};

}  // namespace iirra

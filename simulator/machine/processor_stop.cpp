// A processor that stops.
#include "simulator/machine/processor.hpp"

namespace machine {

void Processor::stop() {
  const bool on_way_back = low_computing_ && !interrupted_ && low_since_ > now();
  if (on_way_back) tell(*running_, Observer::Doing::switching, way_back_from_, now());
  flush_observer();  // accounts for what a low process has computed, too
  if (is_ahead()) {
    use_.busy_high -= high_until_ - now();
    high_until_ = now();
  }
  stopped_at_ = now();
  running_ = interrupted_ = nullptr;
  high_.clear();
  low_.clear();
  high_computing_ = low_computing_ = false;
  ++high_id_;  // what they wait for is of no use any more
  ++timer_id_;
}

}  // namespace machine

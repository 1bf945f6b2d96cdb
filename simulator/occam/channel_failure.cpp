// Channels on a link that is cut.
#include <algorithm>

#include "simulator/machine/faults.hpp"
#include "simulator/occam/channel.hpp"

namespace occam {

// What a process does that nothing can wake any more.
struct ChannelBase::WaitForEver : machine::Wait {
  WaitForEver(const ChannelBase& channel, Side side) : channel(channel), side(side) {}
  std::string describe() const override {
    return fmt::format("{} on {} (link cut)", side == writer ? "out" : "in", channel.name());
  }
  Kind kind() const override { return side == writer ? Kind::output : Kind::input; }
  const ChannelBase& channel;
  Side side;
};

machine::Wait& ChannelBase::wait_for_ever(Side side) {
  if (!for_ever_[side]) for_ever_[side] = std::make_shared<WaitForEver>(*this, side);
  return *for_ever_[side];
}

bool ChannelBase::output_or_fail(std::uint64_t bytes) {
  may_fail_[writer] = true;
  failed_[writer] = false;
  output(bytes);
  may_fail_[writer] = false;
  return !failed_[writer];
}

bool ChannelBase::input_or_fail() {
  may_fail_[reader] = true;
  failed_[reader] = false;
  input();
  may_fail_[reader] = false;
  return !failed_[reader];
}

// The link was cut before the process came.
void ChannelBase::refuse(Process& self, Side side) {
  if (may_fail_[side])
    failed_[side] = true;
  else
    self.block(wait_for_ever(side));
}

// It waits for its partner, or for the end of a transfer (which may not even have begun, if an end
// was ahead of the clock). It is told at its own time.
void ChannelBase::on_cut(Process& process) {
  if (!cut()) return;
  if (std::exchange(ends_[0], nullptr)) {  // told of both ends, or of one if the other stopped
    ends_[1] = nullptr;
    --use_.messages;
    use_.bytes -= bytes_;
  }
  const Side side = users_[writer] == process.id() ? writer : reader;
  (side == writer ? writer_ : reader_) = {};
  if (!may_fail_[side]) return process.wait_instead_for(wait_for_ever(side));
  failed_[side] = true;
  machine::Processor& processor = process.processor();
  processor.make_ready(process, std::max(processor.now(), process.blocked_since()));
}

}  // namespace occam

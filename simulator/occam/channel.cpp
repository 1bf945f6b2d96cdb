#include "simulator/occam/channel.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace occam {

using machine::Seconds;

void charge(Cycles instructions) {
  Process& self = this_process();
  const double factor = self.processor().software_factor();
  self.charge({std::llround(factor * static_cast<double>(instructions.value))});
}

void charge(std::string_view instruction) {
  charge(get_instruction(this_process().processor().model(), instruction));
}

void ChannelBase::pay(Cycles cost) {
  charge(cost);
  this_process().sync_if_long();
}

// Spends what the operation takes up to the rendezvous. The partner may come while a low-priority
// process does: then the copy is spent too, of as many `bytes` as there are by then.
void ChannelBase::arrive(Side side, const std::uint64_t& bytes, const Party& partner) {
  Process& self = this_process();
  const auto& costs = self.processor().model().channel;
  users_[side] = self.id();
  const auto copy = [&] {
    return costs.soft_setup + static_cast<std::int64_t>((bytes + 3) / 4) * costs.copy_word;
  };
  const bool is_outword = side == writer && bytes == 4;
  const Cycles before = is_outword ? costs.operands + costs.out_word : costs.operands;
  const bool came_second = partner.process;
  pay(before + (!hard() && came_second ? copy() : costs.blocked));
  if (!hard() && !came_second && partner.process)
    pay({std::max<std::int64_t>(0, copy().value - costs.blocked.value)});
}

// `doing` is for the deadlock report. Where both ends wait, both wait for the transfer.
void ChannelBase::wait(Process& self, Side side, const char* doing) {
  doing_ = doing;
  waiting_ = side;
  self.block(*this);
}

std::string ChannelBase::describe() const { return fmt::format("{} on {}", doing_, name_); }

std::vector<machine::ProcessId> ChannelBase::waits_for() const {
  const machine::ProcessId partner = users_[waiting_ == writer ? reader : writer];
  return partner ? std::vector{partner} : std::vector<machine::ProcessId>{};
}

void ChannelBase::output(std::uint64_t bytes) {
  Process& self = this_process();
  arrive(writer, bytes, reader_);
  if (cut()) return refuse(self, writer);
  if (writer_.process) throw base::InvariantBroken("two processes output on channel " + name_);
  if (reader_.process) return meet(std::exchange(reader_, {}), bytes);
  writer_ = {&self, self.now()};
  bytes_ = bytes;
  if (alternative_.process) wake_alternative(writer_.since);
  wait(self, writer, "out");
}

void ChannelBase::input() {
  Process& self = this_process();
  arrive(reader, bytes_, writer_);
  if (cut()) return refuse(self, reader);
  if (reader_.process) throw base::InvariantBroken("two processes input on channel " + name_);
  if (writer_.process) return meet(std::exchange(writer_, {}), bytes_);
  reader_ = {&self, self.now()};
  wait(self, reader, "in");
}

// Both ends are here; this process came second.
void ChannelBase::meet(const Party& partner, std::uint64_t bytes) {
  Process& self = this_process();
  machine::Processor& processor = self.processor();
  ++use_.messages;
  use_.bytes += bytes;
  if (!hard()) {
    move_message();
    processor.make_ready(*partner.process, self.now());
    self.sync_if_low();  // a high-priority partner has taken the CPU
    return;
  }
  bytes_ = bytes;
  ends_[0] = partner.process;
  ends_[1] = &self;
  const Seconds start = std::max(self.now(), partner.since);
  if (start > processor.now())
    processor.engine().at(start, [this] { start_transfer(); });
  else
    start_transfer();
  wait(self, ends_[0] == &self ? writer : reader, "transfer");
}

void ChannelBase::start_transfer() {
  if (cut()) return link_->from().engine().ignore_event();
  link_->transfer(bytes_, name_, [this] { end_transfer(); });
}

void ChannelBase::end_transfer() {
  move_message();
  for (Process*& end : ends_) {
    Process& process = *std::exchange(end, nullptr);
    process.processor().make_ready(process, process.processor().now());
  }
}

void ChannelBase::enable(Process& process) {
  alternative_ = {&process, process.now()};
  users_[reader] = process.id();
  alternative_wait_ = process.waits() + 1;                         // the wait about to begin
  if (writer_.process && !cut()) wake_alternative(writer_.since);  // an output ahead of the clock
}

// An output waits from `at` on. Another guard may wake the process before.
void ChannelBase::wake_alternative(Seconds at) {
  Process& waiting = *alternative_.process;
  at = std::max(at, alternative_.since);
  machine::Processor& processor = waiting.processor();
  if (hard() && at > processor.now())
    processor.wake_at(at, waiting, alternative_wait_, &link_->is_cut());
  else if (waiting.state() == Process::State::blocked && waiting.waits() == alternative_wait_)
    processor.make_ready(waiting, at);
}

}  // namespace occam

#include "simulator/occam/channel.hpp"

namespace occam {

using machine::Seconds;

void charge(Seconds duration) { this_process().charge(duration); }

void charge(std::string_view instruction) {
  charge(get_instruction(this_process().processor().model(), instruction));
}

ChannelBase::ChannelBase(std::string name, machine::LinkDirection& link)
    : name_(std::move(name)), link_(&link) {
  link.carry(name_);
  ends_[writer].place = &link.from();
  ends_[reader].place = &link.to();
}

ChannelBase::ChannelBase(std::string name, const machine::Processor& from,
                         const machine::Processor& to)
    : name_(std::move(name)) {
  if (&from != &to && from.companion() != &to)
    throw machine::Misuse(from.name(), from.now(),
                          fmt::format("channel {} would join {} and {}, which have neither a link "
                                      "nor one memory",
                                      name_, from.name(), to.name()));
  ends_[writer].place = &from;
  ends_[reader].place = &to;
}

void ChannelBase::check_may_take(Side side, Process& self) {
  End& end = ends_[side];
  const machine::Processor& here = self.processor();
  if (!end.place) ends_[writer].place = ends_[reader].place = &here;  // a soft channel's first user
  const bool is_here = end.place == &here;
  const auto is_free = [&] { return !end.taken_by || end.taken_by == &self; };
  if (is_here && is_free()) return;
  const Seconds at = self.now();
  if (is_here && is_free()) return;  // by its own time
  std::string why;
  if (is_here)
    why = fmt::format("while {} on {} does: a channel has one writer and one reader",
                      end.taken_by->name(), here.name());
  else if (hard())
    why = fmt::format("which is on link {}: only processes on {} do", link_->name(),
                      end.place->name());
  else if (joins_cpus())
    why = fmt::format("whose end there is on {}", end.place->name());
  else
    why = fmt::format("which is not on a link and has been used on {}: it leads nowhere else",
                      end.place->name());
  throw machine::Misuse(
      self.name(), at,
      fmt::format("{} on {} {} channel {} at {:.6f} s, {}", self.name(), here.name(),
                  side == writer ? "outputs to" : "inputs from", name_, at.value, why));
}

void ChannelBase::pay(Cycles instructions, Cycles copy) {
  charge(instructions);
  this_process().charge(copy);
  if (joins_cpus() && !hard())
    this_process().sync();
  else
    this_process().sync_if_long();
}

// Spends what the operation takes up to the rendezvous. The partner may come while a low-priority
// process does: then the copy is spent too, of as many `bytes` as there are by then.
void ChannelBase::arrive(Side side, const std::uint64_t& bytes, const Party& partner) {
  Process& self = this_process();
  const auto& costs = self.processor().model().channel;
  const auto copy = [&] { return static_cast<std::int64_t>((bytes + 3) / 4) * costs.copy_word; };
  const bool is_outword = side == writer && bytes == 4;
  const Cycles wake = joins_cpus() && !hard() ? costs.wake_companion : Cycles{};
  const Cycles before = is_outword ? costs.operands + costs.out_word : costs.operands;
  const bool came_second = partner.process;
  if (!hard() && came_second) return pay(before + costs.soft_setup, copy() + wake);
  pay(before + costs.blocked, alternative_.process ? wake : Cycles{});
  if (hard() || !partner.process) return;
  // It came meanwhile.
  const Cycles spent = compiled(costs.blocked), whole = compiled(costs.soft_setup) + copy() + wake;
  pay({}, Cycles{std::max<std::int64_t>(0, whole.value - spent.value)});
}

// `doing` is for the deadlock report. Where both ends wait, both wait for the transfer.
void ChannelBase::wait(Process& self, Side side, const char* doing) {
  doing_ = doing;
  waiting_ = side;
  self.block(*this);
}

std::string ChannelBase::describe() const { return fmt::format("{} on {}", doing_, name_); }

std::vector<machine::ProcessId> ChannelBase::waits_for() const {
  const machine::ProcessId partner = ends_[1 - waiting_].user;
  return partner ? std::vector{partner} : std::vector<machine::ProcessId>{};
}

// An output, or an input of as many `bytes` as the partner has said by then.
void ChannelBase::communicate(Side side, const std::uint64_t& bytes) {
  Process& self = this_process();
  Party &own = ends_[side].waiting, &partner = ends_[1 - side].waiting;
  arrive(side, bytes, partner);
  if (cut()) return refuse(self, side);
  if (partner.process) return meet(side, std::exchange(partner, {}), bytes);
  own = {&self, self.own_time()};
  if (side == reader) return wait(self, reader, "in");
  bytes_ = bytes;
  if (alternative_.process) wake_alternative(own.since);
  wait(self, writer, "out");
}

// Both ends are here; this process came second.
void ChannelBase::meet(Side side, const Party& partner, std::uint64_t bytes) {
  Process& self = this_process();
  machine::Processor& processor = partner.process->processor();
  ++use_.messages;
  use_.bytes += bytes;
  if (!hard()) {
    move_message();
    processor.make_ready(*partner.process, self.own_time());
    self.sync_if_low();  // a high-priority partner has taken the CPU
    return;
  }
  bytes_ = bytes;
  transfer_[0] = partner.process;
  transfer_[1] = &self;
  const Seconds start = std::max(self.own_time(), partner.since);
  if (start > processor.now())
    processor.engine().at(start, [this] { start_transfer(); });
  else
    start_transfer();
  wait(self, side, "transfer");
}

void ChannelBase::start_transfer() {
  if (cut()) return link_->from().engine().ignore_event();
  link_->transfer(bytes_, name_, [this] { end_transfer(); });
}

void ChannelBase::end_transfer() {
  move_message();
  for (Process*& end : transfer_) {
    Process& process = *std::exchange(end, nullptr);
    process.processor().make_ready(process, process.processor().now());
  }
}

void ChannelBase::enable(Process& process) {
  const Party& output = ends_[writer].waiting;
  alternative_ = {&process, process.own_time()};
  alternative_wait_ = process.waits() + 1;                       // the wait about to begin
  if (output.process && !cut()) wake_alternative(output.since);  // it is ahead of the clock
}

// An output waits from `at` on. Another guard may wake the process before.
void ChannelBase::wake_alternative(Seconds at) {
  Process& waiting = *alternative_.process;
  at = std::max(at, alternative_.since);
  machine::Processor& processor = waiting.processor();
  if (joins_cpus() && at > processor.now())
    processor.wake_at(at, waiting, alternative_wait_, link_ ? &link_->is_cut() : nullptr);
  else if (waiting.state() == Process::State::blocked && waiting.waits() == alternative_wait_)
    processor.make_ready(waiting, at);
}

// The wait of a process that nothing can wake any more.
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
  auto& wait = ends_[side].for_ever;
  if (!wait) wait = std::make_shared<WaitForEver>(*this, side);
  return *wait;
}

bool ChannelBase::try_to(Side side, const std::uint64_t& bytes) {
  End& end = ends_[side];
  end.may_fail = true;
  end.failed = false;
  communicate(side, bytes);
  end.may_fail = false;
  return !end.failed;
}

// The link was cut before the process came.
void ChannelBase::refuse(Process& self, Side side) {
  if (ends_[side].may_fail)
    ends_[side].failed = true;
  else
    self.block(wait_for_ever(side));
}

// The process waits for its partner, or for the end of a transfer (which may not even have begun,
// if an end was ahead of the clock). It hears of the cut at its own time.
void ChannelBase::on_cut(Process& process) {
  if (!cut()) return;
  if (std::exchange(transfer_[0], nullptr)) {  // the other end may hear of it too, or have stopped
    transfer_[1] = nullptr;
    --use_.messages;
    use_.bytes -= bytes_;
  }
  const Side side = ends_[writer].user == process.id() ? writer : reader;
  End& end = ends_[side];
  end.waiting = {};
  if (!end.may_fail) return process.wait_instead_for(wait_for_ever(side));
  end.failed = true;
  machine::Processor& processor = process.processor();
  processor.make_ready(process, std::max(processor.now(), process.blocked_since()));
}

}  // namespace occam

#include "simulator/occam/channel.hpp"

namespace occam {

using machine::Seconds;

void charge(Seconds duration) { this_process().charge(duration); }

void charge(std::string_view instruction) {
  charge(get_instruction(this_process().processor().model(), instruction));
}

ChannelBase::ChannelBase(std::string name) : name_(std::move(name)) {}

ChannelBase::ChannelBase(std::string name, machine::LinkDirection& link)
    : joins_cpus_(true), link_(&link), name_(std::move(name)) {
  link.carry(name_);
  end_of(writer).place = &link.from();
  end_of(reader).place = &link.to();
}

ChannelBase::ChannelBase(std::string name, const machine::Processor& from,
                         const machine::Processor& to)
    : joins_cpus_(&from != &to), name_(std::move(name)) {
  if (&from != &to && from.companion() != &to)
    throw machine::Misuse(
        from.name(), from.now(),
        fmt::format("channel {} would join {} and {}, which share neither a link nor a memory",
                    name_, from.name(), to.name()));
  end_of(writer).place = &from;
  end_of(reader).place = &to;
}

void ChannelBase::check_may_take(Side side, Process& self) {
  End& end = end_of(side);
  const machine::Processor& here = self.processor();
  if (!end.place)
    // The processor of the first user becomes the processor of both ends of a soft channel.
    end_of(writer).place = end_of(reader).place = &here;
  const bool is_here = end.place == &here;
  const auto is_free = [&] { return !end.taken_by || end.taken_by == &self; };
  if (is_here && is_free()) return;
  if (self.has_stack()) self.sync();
  const Seconds at = self.own_time();
  if (is_here && is_free()) return;
  std::string why;
  if (is_here)
    why = fmt::format("which {} on {} already uses: expected one writer and one reader",
                      end.taken_by->name(), here.name());
  else if (hard())
    why = fmt::format("which is on link {}: expected a process on {}", link_->name(),
                      end.place->name());
  else if (joins_cpus())
    why = fmt::format("whose end for that is on {}: expected a process there", end.place->name());
  else
    why = fmt::format("which is a soft channel of {}: expected a process there", end.place->name());
  throw machine::Misuse(
      self.name(), at,
      fmt::format("{} on {} {} channel {} at {:.6f} s, {}", self.name(), here.name(),
                  side == writer ? "outputs to" : "inputs from", name_, at.value, why));
}

// Called when one part of a message (the tag or size, or the rest) has been communicated. With the
// last part, moves the message itself.
void ChannelBase::move_part() {
  rest_to_come_ = std::exchange(rest_follows_, false);
  if (!rest_to_come_) move_message();
}

// Starts a transfer over the link. Both processes have arrived and have been descheduled.
void ChannelBase::transfer(Process& first, Process& second) {
  transfer_[0] = &first;
  transfer_[1] = &second;
  ++use_.messages;
  use_.bytes += bytes_;
  link_->transfer(bytes_, name_, [this] { end_transfer(); });
}

void ChannelBase::end_transfer() {
  move_part();
  for (Process*& end : transfer_) {
    Process& process = *std::exchange(end, nullptr);
    process.processor().make_ready(process, process.processor().now());
  }
}

void ChannelBase::enable(Process& process) {
  alternative_ = {&process, process.own_time()};
  alternative_wait_ = process.waits() + 1;  // the wait that is about to begin will have this number
  const Party& output = end_of(writer).waiting;
  if (hard() && output.process) look_at(output.since, writer);
}

// Makes the process that waits in an ALT ready, because an output waits from the date `at` on. Has
// no effect if another guard has already woken the process.
void ChannelBase::wake_alternative(Seconds at) {
  Process& waiting = *alternative_.process;
  if (waiting.state() == Process::State::blocked && waiting.waits() == alternative_wait_)
    waiting.processor().make_ready(waiting, std::max(at, alternative_.since));
}

// Makes a process wait at its end of the link, from its own time on (Process::own_time, which may
// be ahead of the clock). Schedules an event only if the arrival can affect another process, and
// then returns true.
bool ChannelBase::come_to_link(Side side, Process& process) {
  const Seconds date = process.blocked_since();
  end_of(side).waiting = {&process, date};
  if (cut()) return look_at(date, side);
  const Party &output = end_of(writer).waiting, &input = end_of(reader).waiting;
  if (output.process && input.process)
    return input.since >= output.since ? look_at(input.since, reader)
                                       : look_at(output.since, writer);
  const bool wakes_alternative = side == writer && alternative_.process;
  return wakes_alternative && look_at(date, side);
}

// Calls look() when the clock reaches `date`. If the clock is already there, returns the result of
// look(); otherwise returns true.
bool ChannelBase::look_at(Seconds date, Side side) {
  if (date <= link_->now()) return look();
  link_->come_at(date, side, [this] {
    if (!look()) link_->ignore_event();
  });
  return true;
}

// Does what is due at the present date: starts a transfer, wakes a process in an ALT, or reports
// that the link was cut. Returns true if this had an effect.
bool ChannelBase::look() {
  const auto has_come = [&](const Party& p) { return p.process && p.since <= link_->now(); };
  Party &output = end_of(writer).waiting, &input = end_of(reader).waiting;
  bool matters = false;
  if (cut()) {
    for (const End& end : ends_) {
      if (!has_come(end.waiting)) continue;
      Process& waiting = *end.waiting.process;
      waiting.tell_cut();
      matters |= waiting.state() == Process::State::ready;
    }
  } else if (has_come(output) && has_come(input)) {
    matters = true;
    const bool input_is_first = input.since < output.since;
    const Party from = std::exchange(output, {}), to = std::exchange(input, {});
    transfer(input_is_first ? *to.process : *from.process,
             input_is_first ? *from.process : *to.process);
  } else if (has_come(output) && alternative_.process) {
    matters = true;
    wake_alternative(output.since);
  }
  return matters;
}

// Cancels the present transfer, if there is one.
void ChannelBase::cancel_transfer() {
  if (!std::exchange(transfer_[0], nullptr)) return;
  transfer_[1] = nullptr;
  --use_.messages;
  use_.bytes -= bytes_;
}

std::string ChannelBase::Exchange::describe() const {
  const auto doing = channel_->transfer_[0] ? "transfer" : side_ == writer ? "out" : "in";
  return fmt::format("{} on {}{}", doing, channel_->name_, channel_->cut() ? " (link cut)" : "");
}

std::vector<machine::ProcessId> ChannelBase::Exchange::waits_for() const {
  const machine::ProcessId partner = channel_->end_of(other_side()).user;
  return partner && !channel_->cut() ? std::vector{partner} : std::vector<machine::ProcessId>{};
}

bool ChannelBase::Exchange::go_on(Process& self) {
  while (communicate(self)) {
    const bool is_all =
        side_ == writer ? rest_ == 0 : !std::exchange(channel_->rest_to_come_, false);
    if (failed() || is_all) {
      channel_->leave(side_);
      return true;
    }
    bytes_ = std::exchange(rest_, 0);
    stage_ = Stage::comes;
  }
  return false;
}

// Executes the communication of one part of the message. Returns true when this part is complete.
bool ChannelBase::Exchange::communicate(Process& self) {
  Party& partner = channel_->end_of(other_side()).waiting;
  switch (stage_) {
    case Stage::comes:
      is_second_ = partner.process;
      if (!pay_to_come(self)) {
        if (channel_->hard()) channel_->link_->expect(side_, self);
        return stop_at(Stage::has_paid);
      }
      [[fallthrough]];
    case Stage::has_paid:
      if (self.has_rank()) channel_->link_->expect_no_more(side_, self);
      if (partner.process && !is_second_ && !channel_->hard() && !pay_for_late_partner(self))
        return stop_at(Stage::has_paid_all);
      [[fallthrough]];
    case Stage::has_paid_all:
      if (side_ == writer) channel_->bytes_ = bytes_;
      if (!channel_->hard() && partner.process) {
        meet(self, std::exchange(partner, {}));
        return true;
      }
      self.start_wait(*this);
      if (channel_->hard())
        channel_->come_to_link(side_, self);
      else
        wait_for_partner(self);
      return stop_at(Stage::over);
    case Stage::over:
      break;
  }
  return true;
}

bool ChannelBase::Exchange::stop_at(Stage next) {
  stage_ = next;
  return false;
}

// Cost of copying the message. For an input, the waiting output determines the number of bytes.
Cycles ChannelBase::Exchange::cost_to_copy(const machine::Model::Channel& costs) const {
  const std::uint64_t bytes = side_ == writer ? bytes_ : channel_->bytes_;
  return static_cast<std::int64_t>((bytes + 3) / 4) * costs.copy_word;
}

// Charges the cost of reaching the rendezvous. Like pay() and pay_for_late_partner(), returns false
// if the process must yield the CPU before it goes on.
bool ChannelBase::Exchange::pay_to_come(Process& self) const {
  const auto& costs = self.processor().model().channel;
  const bool is_outword = side_ == writer && bytes_ == 4;
  const bool wakes = channel_->joins_cpus() && !channel_->hard();
  const Cycles wake = wakes ? costs.wake_companion : Cycles{};
  const Cycles before = is_outword ? costs.operands + costs.out_word : costs.operands;
  if (!channel_->hard() && is_second_)
    return pay(self, before + costs.soft_setup, cost_to_copy(costs) + wake);
  return pay(self, before + costs.blocked,
             wakes && channel_->alternative_.process ? wake : Cycles{});
}

// Charges the copy of the message. Called if the partner reached the soft channel while this
// low-priority process was paying for its own arrival.
bool ChannelBase::Exchange::pay_for_late_partner(Process& self) const {
  const auto& costs = self.processor().model().channel;
  const Cycles wake = channel_->joins_cpus() ? costs.wake_companion : Cycles{};
  const Cycles spent = compiled(costs.blocked);
  const Cycles whole = compiled(costs.soft_setup) + cost_to_copy(costs) + wake;
  return pay(self, {}, Cycles{std::max<std::int64_t>(0, whole.value - spent.value)});
}

bool ChannelBase::Exchange::pay(Process& self, Cycles instructions, Cycles copy) const {
  charge(instructions);
  self.charge(copy);
  const bool at_once =
      channel_->joins_cpus() && (!channel_->hard() || channel_->link_->is_between_parts());
  return !(at_once ? self.must_sync() : self.must_sync_if_long());
}

// Completes a rendezvous for the process that arrived second. If the partner has high priority and
// this process low priority, the partner pre-empts it. This process may still execute up to its
// next payment, which no other process can observe.
void ChannelBase::Exchange::meet(Process& self, Party partner) {
  ++channel_->use_.messages;
  channel_->use_.bytes += channel_->bytes_;
  channel_->move_part();
  partner.process->processor().make_ready(*partner.process, self.own_time());
}

void ChannelBase::Exchange::wait_for_partner(Process& self) {
  Party& own = channel_->end_of(side_).waiting;
  own = {&self, self.blocked_since()};
  if (side_ == writer && channel_->alternative_.process) channel_->wake_alternative(own.since);
}

// Called when the own time (Process::own_time) of a waiting process has moved: moves the start of
// its wait. Events that were scheduled for the old date have no effect.
void ChannelBase::Exchange::on_stretch(Process& process, const machine::Stretch& /*stretch*/) {
  Party& own = channel_->end_of(side_).waiting;
  if (own.process != &process) return;
  own.since = process.blocked_since();
  if (channel_->hard()) channel_->come_to_link(side_, process);
}

// Called when the link has been cut: ends the wait for a partner, or for the end of a transfer.
void ChannelBase::Exchange::on_cut(Process& process) {
  if (!channel_->cut()) return;
  if (process.blocked_since() > channel_->link_->now()) {
    // Without may_fail_, the wait goes on for ever, so an event would only delay the report of a
    // deadlock.
    if (may_fail_) channel_->look_at(process.blocked_since(), side_);
    return;
  }
  channel_->cancel_transfer();
  channel_->end_of(side_).waiting = {};
  if (!may_fail_) return;
  failed_ = true;
  process.processor().make_ready(process, process.processor().now());
}

}  // namespace occam

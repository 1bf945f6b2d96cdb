#include "simulator/occam/channel.hpp"

namespace occam {

using machine::Seconds;

void charge(Seconds duration) { this_process().charge(duration); }

void charge(std::string_view instruction) {
  charge(get_instruction(this_process().processor().model(), instruction));
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

ChannelBase::ChannelBase(std::string name) : name_(std::move(name)) {}

ChannelBase::ChannelBase(std::string name, machine::LinkDirection& link)
    : joins_cpus_(true), link_(&link), name_(std::move(name)) {
  link.carry(name_);
  ends_[writer].place = &link.from();
  ends_[reader].place = &link.to();
}

ChannelBase::ChannelBase(std::string name, const machine::Processor& from,
                         const machine::Processor& to)
    : joins_cpus_(&from != &to), name_(std::move(name)) {
  if (&from != &to && from.companion() != &to)
    throw machine::Misuse(from.name(), from.now(),
                          fmt::format("channel {} would join {} and {}, which have neither a link "
                                      "nor one memory",
                                      name_, from.name(), to.name()));
  ends_[writer].place = &from;
  ends_[reader].place = &to;
}

ChannelBase::~ChannelBase() = default;

void ChannelBase::check_may_take(Side side, Process& self) {
  End& end = ends_[side];
  const machine::Processor& here = self.processor();
  if (!end.place) ends_[writer].place = ends_[reader].place = &here;  // a soft channel's first user
  const bool is_here = end.place == &here;
  const auto is_free = [&] { return !end.taken_by || end.taken_by == &self; };
  if (is_here && is_free()) return;
  if (self.has_stack()) self.sync();
  const Seconds at = self.own_time();
  if (is_here && is_free()) return;
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

// `doing` is for the deadlock report. Where both ends wait, both wait for the transfer.
void ChannelBase::wait(Process& self, Side side, const char* doing) {
  doing_ = doing;
  waiting_ = side;
  self.start_wait(*this);
}

std::string ChannelBase::describe() const { return fmt::format("{} on {}", doing_, name_); }

std::vector<machine::ProcessId> ChannelBase::waits_for() const {
  const machine::ProcessId partner = ends_[1 - waiting_].user;
  return partner ? std::vector{partner} : std::vector<machine::ProcessId>{};
}

void ChannelBase::start_transfer() {
  if (cut()) return link_->from().engine().ignore_event();
  link_->transfer(bytes_, name_, [this] { end_transfer(); });
}

// A tag or a size that more follows moves nothing yet.
void ChannelBase::move_part() {
  rest_to_come_ = std::exchange(rest_follows_, false);
  if (!rest_to_come_) move_message();
}

void ChannelBase::end_transfer() {
  move_part();
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

machine::Wait& ChannelBase::wait_for_ever(Side side) {
  auto& wait = for_ever_[side];
  if (!wait) wait = std::make_unique<WaitForEver>(*this, side);
  return *wait;
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

ChannelBase::Exchange::Exchange(ChannelBase& channel, Parts output, bool may_fail)
    : channel_(&channel),
      bytes_(output.first > 0 ? output.first : output.rest),
      rest_(output.first > 0 ? output.rest : 0),
      side_(writer) {
  channel.rest_follows_ = rest_ > 0;
  begin(may_fail);
}

ChannelBase::Exchange::Exchange(ChannelBase& channel, bool may_fail)
    : channel_(&channel), side_(reader) {
  begin(may_fail);
}

void ChannelBase::Exchange::begin(bool may_fail) {
  channel_->ends_[side_].may_fail = may_fail;
  channel_->ends_[side_].failed = false;
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

// One part of the message.
bool ChannelBase::Exchange::communicate(Process& self) {
  Party &own = channel_->ends_[side_].waiting, &partner = channel_->ends_[1 - side_].waiting;
  switch (stage_) {
    case Stage::comes:
      is_second_ = partner.process;
      if (!pay_to_come(self)) return stop_at(Stage::has_paid);
      [[fallthrough]];
    case Stage::has_paid:
      if (partner.process && !is_second_ && !channel_->hard() && !pay_for_late_partner(self))
        return stop_at(Stage::has_paid_all);
      [[fallthrough]];
    case Stage::has_paid_all:
      if (channel_->cut()) return refuse(self);
      if (partner.process) return meet(self, std::exchange(partner, {}));
      own = {&self, self.own_time()};
      if (side_ == writer) {
        channel_->bytes_ = bytes_;
        if (channel_->alternative_.process) channel_->wake_alternative(own.since);
      }
      channel_->wait(self, side_, side_ == writer ? "out" : "in");
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

// The copy of an input is of as many bytes as the partner has said by then.
Cycles ChannelBase::Exchange::cost_to_copy(const machine::Model::Channel& costs) const {
  const std::uint64_t bytes = side_ == writer ? bytes_ : channel_->bytes_;
  return static_cast<std::int64_t>((bytes + 3) / 4) * costs.copy_word;
}

// Spends what the operation takes up to the rendezvous. These return false if the process has to
// give the CPU up first.
bool ChannelBase::Exchange::pay_to_come(Process& self) const {
  const auto& costs = self.processor().model().channel;
  const bool is_outword = side_ == writer && bytes_ == 4;
  const bool wakes = channel_->joins_cpus() && !channel_->hard();
  const Cycles wake = wakes ? costs.wake_companion : Cycles{};
  const Cycles before = is_outword ? costs.operands + costs.out_word : costs.operands;
  if (!channel_->hard() && is_second_)
    return pay(self, before + costs.soft_setup, cost_to_copy(costs) + wake);
  return pay(self, before + costs.blocked, channel_->alternative_.process ? wake : Cycles{});
}

// The partner may come to a soft channel while a low-priority process spends that: then the copy is
// spent too.
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
  const bool at_once = channel_->joins_cpus() && !channel_->hard();
  return !(at_once ? self.must_sync() : self.must_sync_if_long());
}

// The link was cut before the process came.
bool ChannelBase::Exchange::refuse(Process& self) {
  End& end = channel_->ends_[side_];
  if (end.may_fail) {
    end.failed = true;
    return true;
  }
  self.start_wait(channel_->wait_for_ever(side_));
  return stop_at(Stage::over);
}

// Both ends are here; this process came second.
bool ChannelBase::Exchange::meet(Process& self, Party partner) {
  ChannelBase& channel = *channel_;
  if (side_ == writer) channel.bytes_ = bytes_;
  machine::Processor& processor = partner.process->processor();
  ++channel.use_.messages;
  channel.use_.bytes += channel.bytes_;
  if (!channel.hard()) {
    channel.move_part();
    processor.make_ready(*partner.process, self.own_time());
    if (self.must_sync_if_low()) return stop_at(Stage::over);  // a high partner has taken the CPU
    return true;
  }
  channel.transfer_[0] = partner.process;
  channel.transfer_[1] = &self;
  const Seconds start = std::max(self.own_time(), partner.since);
  if (start > processor.now())
    processor.engine().at(start, [&channel] { channel.start_transfer(); });
  else
    channel.start_transfer();
  channel.wait(self, side_, "transfer");
  return stop_at(Stage::over);
}

}  // namespace occam

#pragma once
// Synchronous, unbuffered channels between two processes. A communication begins when both
// processes have arrived. A soft channel joins two processes that share a memory: on one processor,
// or on two companions. The CPU of the process that arrives second copies the message. A hard
// channel is one direction of a link, whose DMA engine moves the bytes.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "simulator/machine/machine.hpp"

namespace occam {

using machine::Cycles;
using machine::Proc;
using machine::Process;
using machine::this_process;

/// A message without contents, one word long. Every type of message has a function bytes(), its
/// length on a channel, which may depend on the contents.
struct Signal {
  static constexpr std::uint64_t bytes() { return 4; }
};

struct ChannelUse {
  std::uint64_t messages = 0, bytes = 0;
};

/// The part of a channel that does not depend on the message type: waiting processes, and costs of
/// the rendezvous.
class ChannelBase {
 public:
  explicit ChannelBase(std::string name);
  /// Makes a hard channel. The channel must outlive the run. Throws Misuse if the direction of the
  /// link already has a channel.
  ChannelBase(std::string name, machine::LinkDirection& link);
  /// Makes a soft channel within one processor, or between a processor and its companion. To wake a
  /// process on the companion costs channel.wake_companion of the model. Throws Misuse for any
  /// other pair of processors.
  ChannelBase(std::string name, const machine::Processor& from, const machine::Processor& to);
  ChannelBase(const ChannelBase&) = delete;
  ChannelBase& operator=(const ChannelBase&) = delete;

  const std::string& name() const { return name_; }
  const ChannelUse& use() const { return use_; }
  bool hard() const { return link_ != nullptr; }
  /// True if the two ends are on different CPUs. Events at the other end are then known only up to
  /// the present date.
  bool joins_cpus() const { return joins_cpus_; }
  /// True if the link has been cut. Inputs and outputs then block for ever, except those whose
  /// names end in `_or_fail`. Guards of ALTs are then never ready.
  bool cut() const { return link_ && link_->is_cut(); }

  /// Id of the last process that output to this channel; 0 if there was none. Deadlock reports
  /// assume that this process would end the wait of an ALT on the channel.
  machine::ProcessId last_writer() const { return end_of(writer).user; }
  /// True if an output waits now, or will wait from a known future date on. Used by ALTs.
  bool has_output() const { return end_of(writer).waiting.process != nullptr; }
  /// True if an output waits at the date `at`. For a link, a date ahead of the clock is replaced by
  /// the present date.
  bool output_waits(machine::Seconds at) const {
    const Party& waiting = end_of(writer).waiting;
    return waiting.process && waiting.since <= (hard() ? std::min(at, link_->now()) : at) && !cut();
  }
  /// Used by an ALT that finds no output: registers `process`, which waits from its own time on
  /// (Process::own_time). The next output wakes the process, even if this output is already known
  /// and will wait from a later date on.
  void enable(Process& process);
  void disable() { alternative_ = {}; }
  /// Changes the date from which the process registered by enable() waits. Called when that date is
  /// ahead of the clock and has moved.
  void move_enabling(machine::Seconds since) { alternative_.since = since; }
  /// Used by ALTs: reserves the input end for the process, until leave_input(). See take().
  void take_input(Process& process) { take(reader, process); }
  void leave_input() { leave(reader); }

  class Exchange;

 protected:
  using Side = machine::LinkDirection::Side;
  static constexpr Side writer = Side::writer, reader = Side::reader;
  /// The two parts of a message, in bytes: the tag or size (0 if the protocol has none), and the
  /// rest.
  struct Parts {
    std::uint64_t first, rest;
  };
  /// take() and leave() begin and end every operation of a process. take() throws Misuse if another
  /// process is using this end of the channel, or if the process is on the wrong processor. The
  /// right processor is the one at this end of the link. For a soft channel it is the one given to
  /// the constructor, or else the first one that used the channel.
  void take(Side side, Process& process) {
    End& end = end_of(side);
    if (end.place != &process.processor() || end.taken_by) check_may_take(side, process);
    end.taken_by = &process;
    end.user = process.id();
  }
  void leave(Side side) { end_of(side).taken_by = nullptr; }
  virtual void move_message() = 0;
  virtual ~ChannelBase() = default;

 private:
  struct Party {
    Process* process = nullptr;
    // Process::own_time() at the arrival of the process, which may be ahead of the clock.
    machine::Seconds since{};
  };
  struct End {
    Party waiting;  // the process that waits for its partner
    const Process* taken_by = nullptr;
    const machine::Processor* place = nullptr;  // processor on which this end is used, once known
    machine::ProcessId user = 0;  // last process that used this end, for deadlock reports
  };

  End& end_of(Side side) { return ends_[static_cast<std::size_t>(side)]; }
  const End& end_of(Side side) const { return ends_[static_cast<std::size_t>(side)]; }
  void check_may_take(Side side, Process& process);
  void move_part();
  bool come_to_link(Side side, Process& process);
  bool look_at(machine::Seconds date, Side side);
  bool look();
  void transfer(Process& first, Process& second);
  void end_transfer();
  void cancel_transfer();
  void wake_alternative(machine::Seconds at);

  // Members used by ALTs and most communications come first, so that they share cache lines.
  bool joins_cpus_ = false;
  bool rest_follows_ = false;  // another part follows the part that is being sent
  bool rest_to_come_ = false;  // the first part has arrived, the rest has not
  machine::LinkDirection* link_ = nullptr;
  Party alternative_;  // the process in an ALT that has enabled a guard on this channel
  std::uint64_t alternative_wait_ = 0;  // number of the wait of alternative_.process
  std::uint64_t bytes_ = 0;             // length in bytes of the present output
  End ends_[2];                         // indexed by Side
  ChannelUse use_;
  Process* transfer_[2] = {};  // the two processes of the present transfer, by order of arrival
  std::string name_;
};

/// An output or input of a whole message. It begins when its process arrives. It ends when the
/// message has moved or, if failure is allowed, when the link has been cut. A Proc may co_await it.
class [[nodiscard]] ChannelBase::Exchange : public machine::Operation, machine::Wait {
 public:
  Exchange(ChannelBase& channel, Parts output, bool may_fail)
      : channel_(&channel),
        bytes_(output.first > 0 ? output.first : output.rest),
        rest_(output.first > 0 ? output.rest : 0),
        side_(writer),
        may_fail_(may_fail) {
    channel.rest_follows_ = rest_ > 0;
  }
  /// Makes an input.
  Exchange(ChannelBase& channel, bool may_fail)
      : channel_(&channel), side_(reader), may_fail_(may_fail) {}
  bool go_on(Process& self) final;
  /// After completion: true if the link was cut before the whole message had moved.
  bool failed() const { return failed_; }

 private:
  enum class Stage : std::uint8_t { comes, has_paid, has_paid_all, over };
  std::string describe() const override;
  std::vector<machine::ProcessId> waits_for() const override;
  Kind kind() const override { return side_ == reader ? Kind::input : Kind::output; }
  void on_cut(Process& process) override;
  void on_stretch(Process& process, const machine::Stretch& stretch) override;
  bool communicate(Process& self);
  Side other_side() const { return side_ == writer ? reader : writer; }
  bool stop_at(Stage next);
  bool pay(Process& self, Cycles instructions, Cycles copy) const;
  bool pay_to_come(Process& self) const;
  bool pay_for_late_partner(Process& self) const;
  void meet(Process& self, Party partner);
  void wait_for_partner(Process& self);
  Cycles cost_to_copy(const machine::Model::Channel& costs) const;

  ChannelBase* channel_;
  std::uint64_t bytes_ = 0, rest_ = 0;  // rest_: number of bytes after the first part
  Side side_;
  Stage stage_ = Stage::comes;
  bool is_second_ = false, may_fail_ = false, failed_ = false;
};

/// Parts of a message, each communicated separately:
/// - simple: one part.
/// - variant: occam's PROTOCOL with CASE, `channel ! tag; contents`. The first part is the tag (a
///   byte); the contents follow, if there are any.
/// - counted: an array, `channel ! size::message`. First the size (the first word of the message's
///   bytes), then the rest.
enum class Protocol : std::uint8_t { simple, variant, counted };

template <class Message>
class Channel : public ChannelBase {
 public:
  explicit Channel(std::string name, Protocol protocol = Protocol::simple)
      : ChannelBase(std::move(name)), protocol_(protocol) {}
  Channel(std::string name, machine::LinkDirection& link, Protocol protocol = Protocol::simple)
      : ChannelBase(std::move(name), link), protocol_(protocol) {}
  Channel(std::string name, const machine::Processor& from, const machine::Processor& to,
          Protocol protocol = Protocol::simple)
      : ChannelBase(std::move(name), from, to), protocol_(protocol) {}

  /// Outputs a message: `channel ! message`. Blocks until the partner has received it. The
  /// message's bytes() exclude the tag of a variant, but include the size of a counted array.
  void out(Message message) { this_process().carry_out(output(std::move(message))); }
  /// Outputs the message and returns true. If the link is cut before the whole message has moved,
  /// returns false, and the partner receives no part of the message. A failed operation costs as
  /// much as one that has to wait. (OutputOrFail in occam's library.)
  bool out_or_fail(Message message) {
    return this_process().carry_out(output_or_fail(std::move(message))).await_resume();
  }
  /// Inputs a message: `channel ? message`.
  Message in() { return this_process().carry_out(input()).await_resume(); }
  /// Inputs a message; returns nothing if the link is cut before the whole message has arrived.
  std::optional<Message> in_or_fail() {
    return this_process().carry_out(input_or_fail()).await_resume();
  }

  // The next functions make operations for a Proc: co_await channel.output(message), and message =
  // co_await channel.input().
  class OutputOrFail : public Exchange {
   public:
    using Exchange::Exchange;
    bool await_resume() const { return !failed(); }
  };
  template <bool MAY_FAIL>
  class AnInput : public Exchange {
   public:
    explicit AnInput(Channel& from) : Exchange(from, MAY_FAIL), from_(from) {}
    auto await_resume() const {
      if constexpr (MAY_FAIL)
        return failed() ? std::nullopt : std::optional(from_.received());
      else
        return from_.received();
    }

   private:
    Channel& from_;
  };
  using Input = AnInput<false>;
  using InputOrFail = AnInput<true>;
  Exchange output(Message message) { return {*this, prepare(std::move(message)), false}; }
  OutputOrFail output_or_fail(Message message) {
    return {*this, prepare(std::move(message)), true};
  }
  Input input() {
    take(reader, this_process());
    return Input(*this);
  }
  InputOrFail input_or_fail() {
    take(reader, this_process());
    return InputOrFail(*this);
  }
  /// The message of an input that is complete. May be called only once per message.
  Message received() { return std::move(incoming_); }

 private:
  Parts prepare(Message&& message) {
    take(writer, this_process());
    outgoing_ = std::move(message);
    const std::uint64_t bytes = outgoing_.bytes();
    if (protocol_ == Protocol::simple) return {0, bytes};
    if (protocol_ == Protocol::variant) return {1, bytes};
    const auto size = std::min<std::uint64_t>(4, bytes);
    return {size, bytes - size};
  }
  void move_message() override { incoming_ = std::move(outgoing_); }

  Protocol protocol_ = Protocol::simple;
  Message outgoing_, incoming_;
};

// Free functions that look like occam, for the bodies of processes.
template <class Message>
void out(Channel<Message>& channel, Message message) {
  channel.out(std::move(message));
}
template <class Message>
void in(Channel<Message>& channel, Message& message) {
  message = channel.in();
}
inline void in(Channel<Signal>& channel) { channel.in(); }
/// Like out() and in(), but if the link is cut before the whole message has moved, they return
/// false or no message.
template <class Message>
[[nodiscard]] bool out_or_fail(Channel<Message>& channel, Message message) {
  return channel.out_or_fail(std::move(message));
}
template <class Message>
[[nodiscard]] std::optional<Message> in_or_fail(Channel<Message>& channel) {
  return channel.in_or_fail();
}

/// Cycles of instructions in compiled occam code: `instructions` times the processor's software
/// factor.
inline Cycles compiled(Cycles instructions) {
  return machine::round_to_cycles(this_process().processor().software_factor() *
                                  static_cast<double>(instructions.value));
}
/// Charges compiled(instructions).
inline void charge(Cycles instructions) { this_process().charge(compiled(instructions)); }
/// Charges a duration, which is not multiplied by the software factor. See Process::charge.
void charge(machine::Seconds duration);
/// Charges an instruction, given by its name in section [instruction] of the model file:
/// charge("lend").
void charge(std::string_view instruction);

}  // namespace occam

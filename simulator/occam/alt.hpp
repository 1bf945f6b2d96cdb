#pragma once
// ALT and PRI ALT: wait for the first of several inputs.
//
//   pri_alt(when(from_user, command, [&] { obey(command); }),
//           when(is_free, from_sender, signal, [&] { ... }),
//           each(inputs, favourite, [&](std::size_t way, Message message) { ... }),
//           after(deadline, [&] { ... }),
//           otherwise(has_work, [&] { ... }));
//
// The first ready guard in the order written is taken (PRI ALT). A plain ALT leaves the choice
// open, so every ALT here is a PRI ALT. Fair selection rotates the order of the inputs of `each`.
#include <array>
#include <boost/container/small_vector.hpp>
#include <span>
#include <tuple>

#include "simulator/occam/channel.hpp"

namespace occam {

/// What a guard waits for if its condition holds: an output on a channel, a tick of the timer, or
/// nothing (SKIP).
struct Guard {
  enum class Kind : std::uint8_t { skip, channel, timer };

  Guard() = default;
  explicit Guard(ChannelBase* channel, bool condition = true)
      : channel(channel), kind(channel ? Kind::channel : Kind::skip), condition(condition) {}
  static Guard at(std::int64_t tick, bool condition) {
    Guard guard;
    guard.kind = Kind::timer;
    guard.condition = condition;
    guard.tick = tick;
    return guard;
  }

  ChannelBase* channel = nullptr;
  Kind kind = Kind::skip;
  bool condition = true;
  bool replicated = false;  ///< it takes a turn of a replicator, to enable and again to disable it
  bool is_fair = false;     ///< and a division: see fair_each
  std::int64_t tick = 0;    ///< the guard is ready from then on, as wait_until() counts
};

/// Waits until a guard is ready; chosen() is then its index, and its input is still to be done. At
/// least one condition must hold. It charges the transputer's instructions for an ALT: alt, altwt
/// and altend once, enbc and disc for each guard (talt, taltwt, enbt and dist with a timer). A
/// guard whose link is cut is never ready; the link of the chosen one can still be cut before
/// its input is over.
class [[nodiscard]] Select final : public machine::Operation, machine::Wait {
 public:
  /// The guards stay where they are until it is over.
  explicit Select(std::span<const Guard> guards);
  Select(const Select&) = delete;
  Select& operator=(const Select&) = delete;
  bool go_on(Process& self) override;
  std::size_t chosen() const { return chosen_; }

 private:
  enum class Stage : std::uint8_t { comes, enables, enables_late, waits, has_waited, chooses };
  std::string describe() const override;
  std::vector<machine::ProcessId> waits_for() const override;
  Kind kind() const override { return Kind::alternative; }
  void on_stretch(Process& process, const machine::Stretch& stretch) override;
  machine::Seconds span(Cycles cycles) const { return static_cast<double>(cycles.value) * cycle_; }
  bool must_settle(const Process& self) const;
  bool some_ready(const Process& self) const;
  Cycles cost_to_enable_all(const Process& self) const;
  void spend_enabling(Process& self);
  // Each goes on to the next; they return as go_on() does.
  bool spend_wait(Process& self, bool ready);
  bool wait(Process& self);
  bool spend_disabling(Process& self);
  bool choose(Process& self);

  std::span<const Guard> guards_;
  std::size_t chosen_ = 0;
  machine::Seconds begin_{}, from_{};  // of enabling, of disabling
  machine::Seconds cycle_{};           // mean duration of one while it does that
  Cycles enabling_{}, disabling_{};    // of all guards, if none is ready
  Cycles enabled_{};                   // spent for enabling
  Stage stage_ = Stage::comes;
  bool looks_at_others_ = false, has_timer_ = false;
};

/// The same as a call, for a process with a stack.
inline std::size_t select(std::span<const Guard> guards) {
  return this_process().carry_out(Select(guards)).chosen();
}

/// The guards of an ALT; more than 16 of them cost the host an allocation.
using Guards = boost::container::small_vector<Guard, 16>;

// What is written in an ALT has, beside its guards, two functions: begin(i, input) begins the input
// of its guard i, if there is one, and once that is over, end(i, input) does what follows. (An
// input is kept without what its own await_resume() adds.)
using MaybeInput = std::optional<ChannelBase::Exchange>;

inline void begin_input(ChannelBase& from, bool may_fail, MaybeInput& input) {
  from.take_input(this_process());
  input.emplace(from, may_fail);
}

/// `channel ? message`, if the condition holds. Into an optional message nothing is input if the
/// link is cut before all of it has come.
template <class Message, class Into, class Then>
struct InputGuard : Guard {
  static constexpr bool MAY_FAIL = !std::is_same_v<Into, Message>;
  Channel<Message>& from;
  Into& into;
  Then then;
  void begin(std::size_t /*only*/, MaybeInput& input) const { begin_input(from, MAY_FAIL, input); }
  void end(std::size_t /*only*/, const MaybeInput& input) {
    if constexpr (MAY_FAIL)
      into = input->failed() ? std::nullopt : std::optional(from.received());
    else
      into = from.received();
    then();
  }
};

/// SKIP and timers: nothing is input.
template <class Then>
struct PlainGuard : Guard {
  Then then;
  void begin(std::size_t /*only*/, MaybeInput& /*none*/) const {}
  void end(std::size_t /*only*/, const MaybeInput& /*none*/) { then(); }
};

template <class Message, class Into, class Then>
auto when(bool condition, Channel<Message>& from, Into& into, Then then) {
  return InputGuard<Message, Into, Then>{Guard(&from, condition), from, into, std::move(then)};
}
template <class Message, class Into, class Then>
auto when(Channel<Message>& from, Into& into, Then then) {
  return when(true, from, into, std::move(then));
}
/// condition & SKIP
template <class Then>
auto otherwise(bool condition, Then then) {
  return PlainGuard<Then>{Guard(nullptr, condition), std::move(then)};
}
/// TIMER ? AFTER tick - 1
template <class Then>
auto after(std::int64_t tick, Then then) {
  return PlainGuard<Then>{Guard::at(tick, true), std::move(then)};
}
template <class Then>
auto after(bool condition, std::int64_t tick, Then then) {
  return PlainGuard<Then>{Guard::at(tick, condition), std::move(then)};
}

/// The channel of an input of `each` that is a pointer to one. Other kinds of input have a function
/// of this name in their own namespace, and input_from(input), which does the input and may return
/// anything.
template <class Message>
ChannelBase& channel_of(Channel<Message>* input) {
  return *input;
}

/// A replicated guard: one for each input.
template <class Inputs, class Then>
struct Replicated {
  const Inputs& inputs;
  std::size_t favourite;
  bool is_fair;  // the program itself takes the indices modulo their number
  Then then;

  std::size_t size() const { return inputs.size(); }
  std::size_t index(std::size_t i) const { return (favourite + i) % size(); }
  void begin(std::size_t i, MaybeInput& input) const requires
      requires(const Inputs& channels, MaybeInput& begun) {
    begin_input(*channels[0], false, begun);
  }
  {
    charge_turn();
    begin_input(*inputs[index(i)], false, input);
  }
  void end(std::size_t i, const MaybeInput& /*over*/) {
    then(index(i), inputs[index(i)]->received());
  }
  /// The same for other inputs, in a process with a stack.
  void take(std::size_t i) {
    charge_turn();
    then(index(i), input_from(inputs[index(i)]));
  }
  void charge_turn() const {
    const auto& costs = this_process().processor().model().alternative;
    charge(is_fair ? costs.taken + costs.favourite : costs.taken);
    if (is_fair) this_process().charge(2 * costs.modulo);
  }
};

/// ALT i = 0 FOR SIZE inputs. `then` gets the index of the input that was ready, and its message.
/// Which of several is taken is open in occam: here the first from `first` on, which costs nothing.
/// Beside what a guard written out for each input does, it costs the replicator's turns. The
/// inputs, pointers to channels as a rule, stay where they are until the ALT is over.
template <class Inputs, class Then>
auto each(const Inputs& inputs, std::size_t first, Then then) {
  return Replicated<Inputs, Then>{inputs, first, false, std::move(then)};
}

/// PRI ALT i = favourite FOR SIZE inputs, with VAL k IS i REM SIZE inputs (figures 4.12 and 4.14):
/// the program sees to it itself that all have their turn, and pays for the divisions.
template <class Inputs, class Then>
auto fair_each(const Inputs& inputs, std::size_t favourite, Then then) {
  return Replicated<Inputs, Then>{inputs, favourite, true, std::move(then)};
}

inline std::size_t add_guards(const Guard& guard, Guards& guards) {
  guards.push_back(guard);
  return 1;
}
template <class Inputs, class Then>
std::size_t add_guards(const Replicated<Inputs, Then>& replicated, Guards& guards) {
  for (std::size_t i = 0; i < replicated.size(); ++i) {
    Guard& guard = guards.emplace_back(&channel_of(replicated.inputs[replicated.index(i)]));
    guard.replicated = true;
    guard.is_fair = replicated.is_fair;
  }
  return replicated.size();
}

/// Calls `use` with what the guard number `chosen` was written in, and its number there.
template <class Use, class... Written>
void use_chosen(std::size_t chosen, const std::size_t* counts, Use use, Written&... written) {
  const auto use_if_here = [&](auto& one) {
    const std::size_t count = *counts++;
    const bool is_here = chosen < count;
    if (is_here) use(one, chosen);
    chosen -= count;
    return is_here;
  };
  static_cast<void>((use_if_here(written) || ...));
}

/// Waits until one of the guards is ready, inputs its message and does what it says.
template <class... Written>
void pri_alt(Written&&... written) {
  Guards guards;
  const std::size_t counts[] = {add_guards(written, guards)...};
  use_chosen(
      select({guards.data(), guards.size()}), counts,
      [](auto& one, std::size_t i) {
        if constexpr (requires(MaybeInput & begun) { one.begin(i, begun); }) {
          MaybeInput input;
          one.begin(i, input);
          if (input) this_process().carry_out(*input);
          one.end(i, input);
        } else {
          one.take(i);
        }
      },
      written...);
}

/// The same for a Proc: co_await alternative(...). What a guard says must not wait.
template <class... Written>
class [[nodiscard]] Alternative final : public machine::Operation {
 public:
  explicit Alternative(Written&&... written)
      : written_(std::move(written)...),
        counts_(std::apply([&](const auto&... one) { return Counts{add_guards(one, guards_)...}; },
                           written_)),
        select_({guards_.data(), guards_.size()}) {}
  Alternative(const Alternative&) = delete;
  Alternative& operator=(const Alternative&) = delete;

  bool go_on(Process& self) override {
    if (!has_chosen_) {
      if (!select_.go_on(self)) return false;
      has_chosen_ = true;
      use([&](auto& one, std::size_t i) { one.begin(i, input_); });
    }
    return !input_ || input_->go_on(self);
  }
  void await_resume() {
    use([&](auto& one, std::size_t i) { one.end(i, input_); });
  }

 private:
  using Counts = std::array<std::size_t, sizeof...(Written)>;
  template <class Use>
  void use(Use use) {
    std::apply([&](auto&... one) { use_chosen(select_.chosen(), counts_.data(), use, one...); },
               written_);
  }

  std::tuple<Written...> written_;
  Guards guards_;
  Counts counts_;
  Select select_;
  bool has_chosen_ = false;
  MaybeInput input_;
};
template <class... Written>
Alternative<Written...> alternative(Written... written) {
  return Alternative<Written...>(std::move(written)...);
}

/// An ALT over `channels` alone: inputs the message and returns the index of its channel.
template <class Message>
std::size_t fair_alt(std::size_t favourite, std::span<Channel<Message>* const> channels,
                     Message& message) {
  std::size_t chosen = 0;
  pri_alt(fair_each(channels, favourite, [&](std::size_t i, Message input) {
    chosen = i;
    message = std::move(input);
  }));
  return chosen;
}

}  // namespace occam

#pragma once
// ALT and PRI ALT: wait for the first of several inputs.
//
//   pri_alt(when(from_user, command, [&] { obey(command); }),
//           when(is_free, from_sender, signal, [&] { ... }),
//           each(inputs, favourite, [&](std::size_t way, Message message) { ... }),
//           after(deadline, [&] { ... }),
//           otherwise(has_work, [&] { ... }));
//
// PRI ALT chooses the first ready guard in textual order. occam leaves open which ready guard a
// plain ALT chooses, so every ALT here is a PRI ALT. For fairness, `each` starts its search at a
// given input.
#include <array>
#include <boost/container/small_vector.hpp>
#include <span>
#include <tuple>

#include "simulator/occam/channel.hpp"

namespace occam {

/// A guard of an ALT. If its condition is true, the guard becomes ready when an output waits on its
/// channel, at a tick of the timer, or at once (SKIP).
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
  /// True if the guard is one of a replicated ALT. Each enabling and each disabling then also costs
  /// a step of the replicator.
  bool replicated = false;
  /// If true, each enabling and disabling also costs a division, see fair_each.
  bool is_fair = false;
  std::int64_t tick = 0;  ///< first tick at which the guard is ready, counted as in wait_until()
};

/// Waits until a guard is ready. Afterwards chosen() is the guard's index, and the caller must
/// execute the guard's input. The condition of at least one guard must be true. Charges the
/// instructions of an ALT: alt, altwt and altend once, enbc and disc for each guard; with a timer,
/// talt, taltwt, enbt and dist. A guard on a link that is cut is never ready. The link of the
/// chosen guard may still be cut during the input.
class [[nodiscard]] Select final : public machine::Operation, machine::Wait {
 public:
  /// The guards must stay valid until the operation is complete.
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
  // Each of these functions ends by calling the next one, or returns false if the process must
  // wait. The result is that of go_on().
  bool spend_wait(Process& self, bool ready);
  bool wait(Process& self);
  bool spend_disabling(Process& self);
  bool choose(Process& self);

  std::span<const Guard> guards_;
  std::size_t chosen_ = 0;
  machine::Seconds begin_{}, from_{};  // dates at which enabling and disabling began
  machine::Seconds cycle_{};           // mean duration of a cycle during enabling or disabling
  // Cost of enabling and of disabling all guards if none is ready.
  Cycles enabling_{}, disabling_{};
  Cycles enabled_{};  // part of the cost of enabling that has been charged
  Stage stage_ = Stage::comes;
  bool looks_at_others_ = false, has_timer_ = false;
};

/// Select as an ordinary function, for a process with a stack.
inline std::size_t select(std::span<const Guard> guards) {
  return this_process().carry_out(Select(guards)).chosen();
}

/// The guards of an ALT. Up to 16 guards need no memory allocation on the host.
using Guards = boost::container::small_vector<Guard, 16>;

// Each argument of an ALT holds one or more guards and has two functions. begin(i, input) starts
// the input of guard i, if this guard has one. Later, end(i, input) executes the guard's body.
// GuardedInput has no await_resume() that returns the message, unlike other inputs, because end()
// fetches the message.
struct GuardedInput final : ChannelBase::Exchange {
  using Exchange::Exchange;
};
using MaybeInput = std::optional<GuardedInput>;

inline void begin_input(ChannelBase& from, bool may_fail, MaybeInput& input) {
  from.take_input(this_process());
  input.emplace(from, may_fail);
}

/// A guard that inputs: condition & `channel ? message`. If `into` is an optional message, it stays
/// empty when the link is cut before the whole message has arrived.
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

/// A guard that inputs nothing: SKIP, or a tick of the timer.
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
/// The guard `condition & SKIP`.
template <class Then>
auto otherwise(bool condition, Then then) {
  return PlainGuard<Then>{Guard(nullptr, condition), std::move(then)};
}
/// The guard `TIMER ? AFTER tick - 1`, which is ready from `tick` on.
template <class Then>
auto after(std::int64_t tick, Then then) {
  return PlainGuard<Then>{Guard::at(tick, true), std::move(then)};
}
template <class Then>
auto after(bool condition, std::int64_t tick, Then then) {
  return PlainGuard<Then>{Guard::at(tick, condition), std::move(then)};
}

/// Returns the channel of an input of `each`. This overload is for inputs that are pointers to
/// channels. Another type of input needs two functions in its namespace: channel_of(input), and
/// input_from(input), which executes the input and may return any type.
template <class Message>
ChannelBase& channel_of(Channel<Message>* input) {
  return *input;
}

/// Replicated guards: one guard for each input.
template <class Inputs, class Then>
struct Replicated {
  const Inputs& inputs;
  std::size_t favourite;
  bool is_fair;  // if true, the program pays for computing indices modulo size()
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
  /// For inputs other than channels, in a process with a stack: executes the input and the guard's
  /// body.
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

/// ALT i = 0 FOR SIZE inputs. Calls `then` with the index of the input that was ready, and with its
/// message. occam leaves open which ready input is chosen; here the search starts at index `first`,
/// at no cost. Compared with a guard that is not replicated, each guard also costs steps of the
/// replicator. `inputs`, which usually are pointers to channels, must outlive the ALT.
template <class Inputs, class Then>
auto each(const Inputs& inputs, std::size_t first, Then then) {
  return Replicated<Inputs, Then>{inputs, first, false, std::move(then)};
}

/// PRI ALT i = favourite FOR SIZE inputs, with VAL k IS i REM SIZE inputs (thesis, figures 4.12 and
/// 4.14). The simulated program itself changes `favourite` for fairness, and pays for the
/// divisions.
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

/// Finds the argument of an ALT that contains guard number `chosen`. Calls `use` with this argument
/// and with the guard's index within it. `counts` holds the number of guards of each argument.
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

/// Executes a PRI ALT: waits until a guard is ready, inputs its message and executes its body.
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

/// A PRI ALT for a Proc: co_await alternative(...). The bodies of its guards must not wait.
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

/// Executes an ALT whose guards are inputs from `channels`; the search starts at `favourite`.
/// Stores the message and returns the index of its channel.
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

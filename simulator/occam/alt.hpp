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
#include <boost/container/small_vector.hpp>
#include <span>

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
  std::int64_t tick = 0;    ///< the guard is ready from then on, as wait_until() counts
  Cycles turn{}, modulo{};  ///< of its replicator, when it is enabled and again when it is disabled
};

/// Waits until a guard is ready, and returns its index; the input is still to be done, with
/// Channel::in(). At least one condition must hold. Charges the instructions alt, enbc, altwt, disc
/// and altend; where a guard waits for a time, talt, enbt, taltwt and dist too. A guard whose link
/// is cut is never ready; the link of the chosen one can be cut before the input, or during it.
std::size_t select(std::span<const Guard> guards);

/// The guards of an ALT; more than 16 of them cost the host an allocation.
using Guards = boost::container::small_vector<Guard, 16>;

/// `channel ? message`, if the condition holds. Into an optional message nothing is input if the
/// link is cut before all of it has come.
template <class Message, class Into, class Then>
struct InputGuard : Guard {
  Channel<Message>& from;
  Into& into;
  Then then;
  void take(std::size_t /*only*/) {
    if constexpr (std::is_same_v<Into, Message>)
      into = from.in();
    else
      into = from.in_or_fail();
    then();
  }
};

/// SKIP and timers: nothing is input.
template <class Then>
struct PlainGuard : Guard {
  Then then;
  void take(std::size_t /*only*/) { then(); }
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

/// How `each` uses an input that is a pointer to a channel. Other kinds of input have functions of
/// these names in their own namespace; input_from() may return anything.
template <class Message>
ChannelBase& channel_of(Channel<Message>* input) {
  return *input;
}
template <class Message>
Message input_from(Channel<Message>* input) {
  return input->in();
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
  void take(std::size_t i) {
    const auto& costs = this_process().processor().model().alternative;
    charge(is_fair ? costs.taken + costs.favourite : costs.taken);
    if (is_fair) this_process().charge(2 * costs.modulo);
    then(index(i), input_from(inputs[index(i)]));
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
  const auto& costs = this_process().processor().model().alternative;
  for (std::size_t i = 0; i < replicated.size(); ++i) {
    Guard guard(&channel_of(replicated.inputs[replicated.index(i)]));
    guard.turn = costs.replicated;
    if (replicated.is_fair) guard.modulo = costs.modulo;
    guards.push_back(guard);
  }
  return replicated.size();
}

/// Waits until one of the guards is ready, inputs its message and does what it says.
template <class... Written>
void pri_alt(Written&&... written) {
  Guards guards;
  const std::size_t counts[] = {add_guards(written, guards)...};
  std::size_t chosen = select({guards.data(), guards.size()}), place = 0;
  const auto take = [&](auto& guard) {
    const std::size_t count = counts[place++];
    const bool is_here = chosen < count;
    if (is_here) guard.take(chosen);
    chosen -= count;
    return is_here;
  };
  static_cast<void>((take(written) || ...));
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

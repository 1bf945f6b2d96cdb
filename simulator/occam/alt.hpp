#pragma once
// ALT and PRI ALT: wait for the first of several inputs.
//
//   pri_alt(when(from_user, command, [&] { obey(command); }),
//           when(is_free, from_sender, signal, [&] { ... }),
//           after(deadline, [&] { ... }),
//           otherwise(has_work, [&] { ... }));
//
// The first ready guard in the order written is taken (PRI ALT); a plain ALT leaves the choice
// open, so every ALT here is a PRI ALT. Fair selection rotates the order: see fair_alt.
#include <array>
#include <span>

#include "simulator/occam/channel.hpp"

namespace occam {

// What a guard waits for: an output on a channel, a tick of the timer, or nothing (SKIP), if its
// condition holds.
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
  std::int64_t tick = 0;  // ready from then on, as wait_until() counts
};

// Waits until a guard is ready, and returns its index; the input is still to be done, with
// Channel::in(). At least one condition must hold. Source: the instructions alt, enbc, altwt,
// disc, altend, with timers talt, enbt, taltwt, dist. A guard whose link is cut is never ready; the
// link of the one chosen can be cut before the input, or during it.
std::size_t select(std::span<const Guard> guards);

constexpr std::size_t MAX_REPLICAS = 8;

// PRI ALT i = favourite FOR n over `channels`, indices taken modulo n: the fair choice. Inputs the
// message and returns the index of its channel.
template <class Message>
std::size_t fair_alt(std::size_t favourite, std::span<Channel<Message>* const> channels,
                     Message& message) {
  std::array<Guard, MAX_REPLICAS> guards;
  const std::size_t n = channels.size();
  for (std::size_t i = 0; i < n; ++i) guards.at(i) = Guard(channels[(favourite + i) % n]);
  const std::size_t chosen = (favourite + select({guards.data(), n})) % n;
  message = channels[chosen]->in();
  return chosen;
}

template <class Message, class Then>
struct InputGuard : Guard {
  Channel<Message>& from;
  Message& into;
  Then then;
  void take() {
    into = from.in();
    then();
  }
};

// Then without a message if the link is cut before it is here.
template <class Message, class Then>
struct FallibleInputGuard : Guard {
  Channel<Message>& from;
  std::optional<Message>& into;
  Then then;
  void take() {
    into = from.in_or_fail();
    then();
  }
};

// SKIP and timers: nothing to input.
template <class Then>
struct PlainGuard : Guard {
  Then then;
  void take() { then(); }
};

template <class Message, class Then>
auto when(bool condition, Channel<Message>& from, Message& into, Then then) {
  return InputGuard<Message, Then>{Guard(&from, condition), from, into, std::move(then)};
}
template <class Message, class Then>
auto when(Channel<Message>& from, Message& into, Then then) {
  return when(true, from, into, std::move(then));
}
template <class Message, class Then>
auto when(bool condition, Channel<Message>& from, std::optional<Message>& into, Then then) {
  return FallibleInputGuard<Message, Then>{Guard(&from, condition), from, into, std::move(then)};
}
template <class Message, class Then>
auto when(Channel<Message>& from, std::optional<Message>& into, Then then) {
  return when(true, from, into, std::move(then));
}
// condition & SKIP
template <class Then>
auto otherwise(bool condition, Then then) {
  return PlainGuard<Then>{Guard(nullptr, condition), std::move(then)};
}
// TIMER ? AFTER tick - 1
template <class Then>
auto after(std::int64_t tick, Then then) {
  return PlainGuard<Then>{Guard::at(tick, true), std::move(then)};
}
template <class Then>
auto after(bool condition, std::int64_t tick, Then then) {
  return PlainGuard<Then>{Guard::at(tick, condition), std::move(then)};
}

template <class... Guards>
void pri_alt(Guards&&... guards) {
  const std::array<Guard, sizeof...(guards)> all{static_cast<const Guard&>(guards)...};
  const std::size_t chosen = select(all);
  std::size_t i = 0;
  ((i++ == chosen ? guards.take() : void()), ...);
}

}  // namespace occam

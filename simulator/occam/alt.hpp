#pragma once
// ALT and PRI ALT: wait for the first of several inputs.
//
//   pri_alt(when(from_user, command, [&] { obey(command); }),
//           when(is_free, from_sender, signal, [&] { ... }),
//           otherwise(has_work, [&] { ... }));
//
// The first ready guard in the order written is taken (PRI ALT); a plain ALT leaves the choice
// open, so every ALT here is a PRI ALT. Fair selection rotates the order: see fair_alt.
#include <array>
#include <span>

#include "simulator/occam/channel.hpp"

namespace occam {

// What a guard waits for: a channel (null for SKIP), if its condition holds.
struct Guard {
  ChannelBase* channel = nullptr;
  bool condition = true;
};

// Waits until a guard is ready, and returns its index; the input is still to be done, with
// Channel::in(). At least one condition must hold. Source: the instructions alt, enbc, altwt,
// disc, altend.
std::size_t select(std::span<const Guard> guards);

constexpr std::size_t MAX_REPLICAS = 8;

// PRI ALT i = favourite FOR n over `channels`, indices taken modulo n: the fair choice. Inputs the
// message and returns the index of its channel.
template <class Message>
std::size_t fair_alt(std::size_t favourite, std::span<Channel<Message>* const> channels,
                     Message& message) {
  std::array<Guard, MAX_REPLICAS> guards;
  const std::size_t n = channels.size();
  for (std::size_t i = 0; i < n; ++i) guards.at(i).channel = channels[(favourite + i) % n];
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

template <class Then>
struct SkipGuard : Guard {
  Then then;
  void take() { then(); }
};

template <class Message, class Then>
auto when(bool condition, Channel<Message>& from, Message& into, Then then) {
  return InputGuard<Message, Then>{{&from, condition}, from, into, std::move(then)};
}
template <class Message, class Then>
auto when(Channel<Message>& from, Message& into, Then then) {
  return when(true, from, into, std::move(then));
}
// condition & SKIP
template <class Then>
auto otherwise(bool condition, Then then) {
  return SkipGuard<Then>{{nullptr, condition}, std::move(then)};
}

template <class... Guards>
void pri_alt(Guards&&... guards) {
  const std::array<Guard, sizeof...(guards)> all{static_cast<const Guard&>(guards)...};
  const std::size_t chosen = select(all);
  std::size_t i = 0;
  ((i++ == chosen ? guards.take() : void()), ...);
}

}  // namespace occam

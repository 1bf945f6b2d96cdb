#pragma once
// A soak of routers: processes all over a network send each other messages of every kind at random
// and keep account of each.
#include <cstdint>
#include <string>
#include <vector>

#include "simulator/declare/program.hpp"

namespace programs {

struct SoakParams {
  std::uint64_t messages = 1000;        // sent, by all processors together
  std::uint64_t longest = 100;          // bytes of contents: 0 to this
  double pause_s = 1e-3;                // between two messages of one sender, on average
  double global = 0.02, in_path = 0.2;  // shares of all messages; the others are unicast
  std::uint64_t seed = 1;
};

struct SoakResult {
  std::uint64_t sent = 0, expected = 0;  // messages; deliveries that they ask for
  std::uint64_t delivered = 0;           // the right ones, each once
  std::uint64_t duplicated = 0, misdelivered = 0;
  std::uint64_t reordered = 0;     // came after a later one of the same sender, receiver and mode
  std::uint64_t returned = 0;      // came back to their senders, with a reason
  std::uint64_t lost = 0;          // neither
  double time_s = 0;               // simulated
  double links_mean = 0;           // that a delivered message has passed
  std::size_t most_held = 0;       // messages in one router
  std::vector<std::string> notes;  // what was lost, by sender and receiver
};

// On the network of `setup`, whose pattern has router_parameters. Throws what the simulation
// throws: a router without a method deadlocks.
SoakResult run_soak(const Setup& setup, const SoakParams& params);

}  // namespace programs

// Routers whose output is saturated must serve their inputs in turn.
#include <gtest/gtest.h>

#include <array>

#include "tests/simulator/network/router_support.hpp"

namespace network {
namespace {

// In a star, processors 1 to 4 are linked only to the hub, processor 0. Processors 1 to 3 send
// messages to processor 4 as fast as possible. Returns the sender of each message, in order of
// arrival.
std::vector<double> find_senders(Method method, std::uint64_t bytes) {
  return test::isolated_numbers([&] {
    Params params;
    params.method = method;
    Bench bench(topologies::make_topology("star:5"), params);
    std::vector<double> senders;
    bench.start_sink(4, [&](const Message& message) { senders.push_back(message.from.processor); });
    for (const int from : {1, 2, 3})
      bench.start(from, [&](Client& client) {
        for (std::uint64_t i = 0; i < 60; ++i) client.send(make_message({4, 0}, i, bytes));
      });
    bench.machine.run();
    return senders;
  });
}

// While processors 1 to 3 all have messages to send, at least 3 of any 24 successive messages must
// come from each of them. The three numbers differ: if an input is idle, the hub passes its turn to
// the next active input.
TEST(RouterFairness, EveryLinkInHasItsTurn) {
  for (const Method method : {Method::chalmers, Method::green, Method::acyclic, Method::naive})
    for (const std::uint64_t bytes : {4, 100}) {
      const auto senders = find_senders(method, bytes);
      ASSERT_EQ(senders.size(), 180u);
      constexpr std::size_t WINDOW = 24, SETTLED = 12, LAST = 84;
      for (std::size_t at = SETTLED; at + WINDOW <= LAST; ++at)
        for (const int from : {1, 2, 3})
          ASSERT_GE(std::count(senders.begin() + static_cast<long>(at),
                               senders.begin() + static_cast<long>(at + WINDOW), from),
                    3)
              << "method " << static_cast<int>(method) << ", " << bytes << " bytes, from " << from
              << " at " << at;
    }
}

}  // namespace
}  // namespace network

// Routers on processors with several links between two neighbours.
#include <gtest/gtest.h>

#include "simulator/network/store_and_forward.hpp"
#include "simulator/programs/network/traffic.hpp"
#include "tests/simulator/network/router_support.hpp"

namespace network {
namespace {

topologies::Topology pair_joined_by(int links) {
  topologies::Topology pair{"pair", 2, 0, {}, {}, {}};
  for (int port = 0; port < links; ++port) pair.links.push_back({{0, port}, {1, port}});
  return pair;
}

constexpr int CLIENTS = 4;
constexpr std::uint64_t BYTES = 100'000, MESSAGES = 8;

// Each process of one processor sends messages to a process of the other. Returns the total time in
// seconds. Checks that the messages of each process arrive in order.
std::string time_of(int links, Method method) {
  return isolated([&] {
    Params params;
    params.method = method;
    params.longest = BYTES;
    params.processes = {{1, 2, 4, 8}, {1, 2, 4, 8}};
    Bench bench(pair_joined_by(links), params, {}, 16 << 20);
    double end = 0;
    std::string wrong;
    const auto start = [&](int id, int n, const std::function<void(Client&)>& body) {
      bench.machine.processors()[static_cast<std::size_t>(id)]->start(
          "application", occam::Priority::low,
          [&bench, id, n, body] { body(bench.network->client(id, n)); });
    };
    for (int n = 0; n < CLIENTS; ++n) {
      start(0, n, [n](Client& client) {
        for (std::uint64_t i = 0; i < MESSAGES; ++i) {
          auto message = make_message({1, n}, i, i % 2 ? BYTES : 4);
          message.from.process = n;
          client.send(message);
        }
      });
      start(1, n, [&](Client& client) {
        for (std::uint64_t i = 0; i < MESSAGES; ++i)
          if (client.receive().number != i) wrong = "out of order";
        end = std::max(end, occam::this_process().now().value);
      });
    }
    bench.machine.run();
    return wrong.empty() ? fmt::format("{}", end) : wrong;
  });
}

// In the acyclic method, inputs work concurrently: four streams on two links must take half the
// time, or three quarters if three of them share a link. Chalmers's and Green's routers input only
// one message at a time.
TEST(ParallelLinks, CarryStreamsSideBySideAndKeepEachInOrder) {
  for (const Method method : METHODS) {
    const double one = std::stod(time_of(1, method)), two = std::stod(time_of(2, method));
    EXPECT_LT(two / one, method == Method::acyclic ? 0.76 : 1.01) << static_cast<int>(method);
    EXPECT_GT(two / one, method == Method::acyclic ? 0.49 : 0.98) << static_cast<int>(method);
  }
}

// Returns the number of messages on each link from processor 0 to 1, after a process on 0 has sent
// six messages to a process on 1.
std::vector<double> loads_of(int links, Method method) {
  return occam::isolated_numbers([&] {
    Params params;
    params.method = method;
    Bench bench(pair_joined_by(links), params);
    bench.start_sink(1);
    bench.start(0, [](Client& client) {
      for (std::uint64_t i = 0; i < 6; ++i) client.send(make_message({1, 0}, i));
    });
    bench.machine.run();
    std::vector<double> messages;
    for (const auto& link : bench.machine.links())
      if (&link->from() == bench.machine.processors()[0].get())
        messages.push_back(static_cast<double>(link->use().messages));
    return messages;
  });
}

// All messages between two processes must take the same one of several parallel links.
TEST(ParallelLinks, RoutersPutAPairOfProcessesOnOne) {
  for (const Method method : METHODS) {
    const double one = loads_of(1, method).at(0);
    auto two = loads_of(2, method);
    std::ranges::sort(two);
    EXPECT_GE(one, 6);
    EXPECT_EQ(two, (std::vector<double>{0, one})) << static_cast<int>(method);
  }
}

TEST(ParallelLinks, TrafficAlternates) {
  const auto busy = [](int links) {
    return std::stod(isolated([&] {
      const auto model = machine::load_model("t805-25");
      std::vector<programs::Arrival> arrivals;
      for (int i = 0; i < 6; ++i) arrivals.push_back({10'000 * i, 0, 1});
      const auto result =
          programs::run_traffic(programs::Setup{model, pair_joined_by(links)}, arrivals, 1000);
      return fmt::format("{}", result.link_busy_max);
    }));
  };
  EXPECT_NEAR(busy(2), busy(1) / 2, 1e-3 * busy(1));
  EXPECT_NEAR(busy(3), busy(1) / 3, 1e-3 * busy(1));
  // The messages divide over the four links as two, two, one and one.
  EXPECT_NEAR(busy(4), busy(1) / 3, 1e-3 * busy(1));
}

TEST(ParallelLinks, TakeMessagesToAllOnce) {
  for (const Method method : METHODS)
    EXPECT_EQ(isolated([&] {
                Params params;
                params.method = method;
                Bench bench(pair_joined_by(3), params);
                int got = 0;
                bench.start_sink(1, [&](const Message&) { ++got; });
                bench.start(0, [&](Client& client) {
                  for (int i = 0; i < 10; ++i) client.send(make_message(make_global(0)));
                });
                bench.machine.run();
                return fmt::format("{}", got);
              }),
              "10");
}

}  // namespace
}  // namespace network

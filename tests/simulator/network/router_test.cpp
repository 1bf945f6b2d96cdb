// Routers: addresses, GLOBAL and InPathTo messages, memory limits, and cut links.
#include <gtest/gtest.h>

#include <set>

#include "base/errors.hpp"
#include "tests/simulator/network/router_support.hpp"
#include "topologies/make/generators.hpp"

namespace network {

namespace {

// Runs `body` in a child process. Fails if an expectation fails there.
void expect_in_child(const std::function<void()>& body) {
  EXPECT_EQ(isolated([&] {
              body();
              return std::string(testing::Test::HasFailure() ? "failed, see above" : "");
            }),
            "");
}

Params with(Method method) {
  Params params;
  params.method = method;
  return params;
}

}  // namespace

TEST(Router, AddressesThatDoNotExistComeBackWithTheReason) {
  for (const Method method : METHODS)
    expect_in_child([&] {
      Params params = with(method);
      params.processes.assign(4, {0b11});  // each processor has only the processes 0 and 1
      Bench bench(topologies::make_topology("line:4"), params);
      for (int id = 1; id < 4; ++id) bench.start_sink(id);
      std::vector<Returned> reasons;
      bench.start(0, [&](Client& client) {
        for (const Address to : {Address{4, 0}, Address{-1, 0}, Address{3, 2}, Address{2, 99}}) {
          client.send(make_message(to, 7));
          const Message back = client.receive();
          EXPECT_EQ(back.number, 7u);
          EXPECT_EQ(back.from, to);
          reasons.push_back(back.returned);
        }
      });
      bench.machine.run();
      EXPECT_EQ(reasons, (std::vector{Returned::no_processor, Returned::no_processor,
                                      Returned::no_process, Returned::no_process}));
      EXPECT_EQ(bench.network->use().returned, 4u);
    });
}

TEST(Router, TwoClientsOfOneProcessorHaveTheirOwnMessages) {
  for (const Method method : METHODS)
    expect_in_child([&] {
      Params params = with(method);
      params.processes = {{1}, {0b10, 0b100}};
      Bench bench(topologies::make_topology("line:2"), params);
      std::vector<int> got;
      for (int n = 0; n < 2; ++n)
        bench.machine.processors()[1]->start("application", occam::Priority::low, [&, n] {
          const Message message = bench.network->client(1, n).receive();
          EXPECT_EQ(message.to.process, n + 1);
          got.push_back(n);
        });
      bench.start(0, [](Client& client) {
        client.send(make_message({1, 2}));
        client.send(make_message({1, 1}));
      });
      bench.machine.run();
      EXPECT_EQ(got.size(), 2u);
    });
}

TEST(Router, GlobalReachesEveryOtherProcessorAlongEitherKindOfTree) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const Method method : METHODS)
      for (const bool single : {false, true})
        expect_in_child([&] {
          const auto topology = random_topology(static_cast<unsigned>(seed));
          std::optional<TreeLinks> tree;
          if (single) tree = make_tree_links(topology);
          Bench bench(topology, with(method), tree);
          const int n = topology.processors, sender = static_cast<int>(seed) % n;
          std::vector<int> times(static_cast<std::size_t>(n));
          for (int id = 0; id < n; ++id)
            if (id != sender) bench.start_sink(id, [&, id](const Message&) { ++times[id]; });
          bench.start(sender, [](Client& client) {
            for (int i = 0; i < 3; ++i) client.send(make_message(make_global(0)));
          });
          bench.machine.run();
          for (int id = 0; id < n; ++id) EXPECT_EQ(times[id], id == sender ? 0 : 3) << id;
          // The tree has one link fewer than processors, and each message must pass each of these
          // links once.
          std::uint64_t moved = 0;
          for (const auto& link : bench.machine.links()) moved += link->use().bytes;
          EXPECT_EQ(moved, 3u * static_cast<unsigned>(n - 1) * 24);
        });
}

// A message must be offered to the processors on its route that have the process. The nearest of
// them is first. The offers end when a processor keeps the message.
TEST(Router, InPathToIsOfferedOnTheWay) {
  for (const Method method : METHODS)
    expect_in_child([&] {
      Params params = with(method);
      params.processes.assign(6, {1});
      // processor 2 has no process 0, so messages pass it without being offered
      params.processes[2] = {0b10};
      Bench bench(topologies::make_topology("line:6"), params);
      std::vector<int> asked;
      for (int id = 1; id < 6; ++id)
        bench.start(id, [&, id](Client& client) {
          occam::this_process().set_server();
          for (;;) {
            const Message message = client.receive();
            asked.push_back(id);
            EXPECT_EQ(message.from.processor, 0);
            if (id < 4) client.give_back(message);
          }
        });
      bench.start(0, [](Client& client) { client.send(make_message({5, 0, Mode::in_path_to})); });
      bench.machine.run();
      EXPECT_EQ(asked, (std::vector{1, 3, 4}));
    });
}

TEST(Router, NoRoomIsAFaultThatNamesTheRouter) {
  for (const Method method : {Method::chalmers, Method::green}) {
    const auto text = isolated([&] {
      Params params = with(method);
      params.buffers = 3;
      Bench bench(topologies::make_topology("line:2"), params);
      bench.start(0, [](Client& client) {
        for (int i = 0; i < 20; ++i) client.send(make_message({1, 0}));
      });
      // A client that takes no messages from its router.
      bench.start(1, [](Client&) { occam::wait_until(1'000'000); });
      try {
        bench.machine.run();
      } catch (const Overflow& overflow) {
        return fmt::format("{}: {}", overflow.who, overflow.what());
      }
      return std::string("no fault");
    });
    EXPECT_NE(text.find(" has no free buffer for another message: all 3 are in use"),
              std::string::npos)
        << text;
  }
}

TEST(Router, BuffersAndMessagesMustFitTheMemory) {
  const auto text = isolated([] {
    Params params;
    params.longest = 1 << 20;
    try {
      Bench bench(topologies::make_topology("line:2"), params);
    } catch (const base::BadInput& wrong) {
      return std::string(wrong.what());
    }
    return std::string("accepted");
  });
  EXPECT_NE(text.find("64 messages of 1048576 bytes"), std::string::npos) << text;
  EXPECT_NE(text.find("found 4194304 bytes of memory left"), std::string::npos) << text;
}

// In ring:4, the route from 0 to 2 passes 1 or 3. If link 0-1 is cut, it must pass 3; if link 0-3
// is cut as well, messages must return.
TEST(Router, GoesAroundACutLinkOrSaysThatNoWayIsLeft) {
  for (const Method method : METHODS)
    expect_in_child([&] {
      Bench bench(topologies::make_topology("ring:4"), with(method));
      auto& p = bench.machine.processors();
      bench.machine.cut_link(*p[0], *p[1], {0.01});
      bench.machine.cut_link(*p[0], *p[3], {0.02});
      std::vector<std::uint64_t> got;
      for (int id = 1; id < 4; ++id)
        bench.start_sink(id, [&](const Message& message) { got.push_back(message.number); });
      bench.start(0, [](Client& client) {
        client.send(make_message({2, 0}, 1));
        occam::wait_until(occam::ticks({0.015}));
        client.send(make_message({1, 0}, 2));
        occam::wait_until(occam::ticks({0.025}));
        client.send(make_message({3, 0}, 3));
        EXPECT_EQ(client.receive().returned, Returned::no_route);
      });
      bench.machine.run();
      EXPECT_EQ(got, (std::vector<std::uint64_t>{1, 2}));
    });
}

// Messages in transit when a link is cut, also long ones, must take another route and arrive once.
TEST(Router, MessagesUnderWayWhenALinkIsCutArriveOnce) {
  for (const Method method : METHODS)
    for (int at_us = 300; at_us < 3000; at_us += 130)
      expect_in_child([&] {
        Bench bench(topologies::make_topology("ring:4"), with(method));
        auto& p = bench.machine.processors();
        bench.machine.cut_link(*p[0], *p[1], {1e-6 * at_us});
        std::vector<std::multiset<std::uint64_t>> got(4);
        for (int id = 1; id < 4; ++id)
          bench.start_sink(id, [&, id](const Message& m) { got[id].insert(m.number); });
        bench.start(0, [](Client& client) {
          for (std::uint64_t i = 0; i < 6; ++i) {
            client.send(make_message({1, 0}, i, 300));
            client.send(make_message(make_global(0), 100 + i, 300));
          }
        });
        bench.machine.run();
        EXPECT_EQ(got[1].size(), 12u) << at_us;
        for (int id = 1; id < 4; ++id)
          for (std::uint64_t i = 0; i < 6; ++i) EXPECT_EQ(got[id].count(100 + i), 1u) << at_us;
      });
}

// If messages are passed as pointers, the time must grow with the length only because of the link.
// If they are copied, each byte is copied three times more: into the router, to the sender process
// that serves the client, and to the client.
TEST(Router, CopiesCostMemoryCyclesAByte) {
  const auto latency = [](bool pointers, std::uint64_t bytes) {
    return occam::isolated_numbers([&] {
      Params params = with(Method::green);
      params.pointers = pointers;
      params.longest = bytes;
      Bench bench(topologies::make_topology("line:2"), params);
      double arrived = 0;
      bench.start(0, [bytes](Client& client) { client.send(make_message({1, 0}, 0, bytes)); });
      bench.start(1, [&](Client& client) {
        client.receive();
        arrived = occam::this_process().now().value;
      });
      bench.machine.run();
      return occam::Numbers{arrived};
    })[0];
  };
  const auto model = machine::load_model("t805-25");
  const double words = 1000, copy_s = words * static_cast<double>(model.channel.copy_word.value) /
                                      model.cpu.clock.value;
  const double more_copied = latency(false, 4000) - latency(false, 0),
               more_pointed = latency(true, 4000) - latency(true, 0);
  // Copies: from client to router, to the sender process, and to the client.
  EXPECT_NEAR(more_copied - more_pointed, 3 * copy_s, 0.01 * copy_s);
  EXPECT_NEAR(more_pointed, 4000 / model.link.one_way_rate, 0.02 * more_pointed);
}

}  // namespace network

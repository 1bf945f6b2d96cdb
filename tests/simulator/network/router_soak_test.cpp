// Soak test of all routers on random networks: every message must arrive once, at its destination,
// and in order.
#include <gtest/gtest.h>

#include <random>

#include "tests/simulator/network/router_support.hpp"
#include "tests/simulator/programs/run_program.hpp"
#include "topologies/make/generators.hpp"

namespace network {

namespace {

using programs::Settings, programs::get_number;
using SoakOutcome = programs::Outcome<programs::Row>;

SoakOutcome run_soak(const topologies::Topology& topology, const Settings& settings,
                     const std::vector<programs::PlannedFault>& faults = {}) {
  const auto model = machine::load_model("t805-25");
  programs::Setup setup{model, topology};
  setup.routes = topologies::make_routes(topology);
  setup.faults = faults;
  return programs::run_program("soak", setup, settings);
}

std::string to_text(const SoakOutcome& outcome) {
  std::string text;
  for (const auto& [name, cell] : outcome.rows.at(0))
    text += fmt::format("{}={:a} ", name, get_number(outcome.rows[0], name));
  for (const auto& note : outcome.notes) text += note + "\n";
  return text;
}

// True if the network stays connected when the links in `faults` are cut.
bool stays_joined(topologies::Topology topology,
                  const std::vector<programs::PlannedFault>& faults) {
  std::erase_if(topology.links, [&](const auto& link) {
    return std::ranges::any_of(faults, [&](const auto& f) {
      const int a = link.a.processor, b = link.b.processor;
      return (f.a == a && f.b == b) || (f.a == b && f.b == a);
    });
  });
  try {
    topologies::check(topology);
    return true;
  } catch (const base::BadInput&) {
    return false;
  }
}

constexpr const char* BY_SEED[] = {"green", "chalmers", "acyclic"};

}  // namespace

TEST(RouterSoak, RandomNetworksLoseNothing) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto topology = random_topology(static_cast<unsigned>(seed), 64);
    const Settings settings{{"method", BY_SEED[seed % 3]},
                            {"within", random() % 2 == 0 ? "pointers" : "copies"},
                            {"buffers", 20000},
                            {"messages", 300},
                            {"message_bytes", static_cast<std::int64_t>(random() % 40)},
                            {"pause_s", random() % 2 == 0 ? 2e-4 : 5e-3},
                            {"global_share", 0.1},
                            {"seed", static_cast<std::int64_t>(seed)}};
    isolated([&] {
      const auto outcome = run_soak(topology, settings);
      const auto& row = outcome.rows.at(0);
      EXPECT_EQ(get_number(row, "delivered"), get_number(row, "expected"));
      for (const char* wrong : {"lost", "duplicated", "misdelivered", "reordered", "returned"})
        EXPECT_EQ(get_number(row, wrong), 0) << wrong;
      if (testing::Test::HasFailure()) throw std::runtime_error(to_text(outcome));
      return std::string();
    });
  }
}

TEST(RouterSoak, TheSameTwice) {
  for (const char* method : BY_SEED) {
    const auto once = [&] {
      return isolated([&] {
        return to_text(run_soak(random_topology(7), {{"method", method}, {"buffers", 20000}}));
      });
    };
    EXPECT_EQ(once(), once());
  }
}

// Between processors that run, each message that is not delivered must return or be reported as
// lost.
TEST(RouterSoak, FailuresLoseNothingUnsaid) {
  for (std::uint64_t seed = 1; seed <= 45; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto topology = random_topology(static_cast<unsigned>(seed));
    std::vector<programs::PlannedFault> faults;
    const bool only_links = random() % 2 == 0;
    for (std::uint64_t i = random() % 4; i > 0; --i) {
      const auto& link = topology.links[random() % topology.links.size()];
      faults.push_back(
          {1e-4 * static_cast<double>(random() % 300), link.a.processor, link.b.processor});
    }
    if (!only_links)
      faults.push_back({1e-4 * static_cast<double>(random() % 300),
                        static_cast<int>(random() % static_cast<unsigned>(topology.processors))});
    const Settings settings{{"method", BY_SEED[seed % 3]},
                            {"buffers", 20000},
                            {"messages", 300},
                            {"pause_s", 2e-3},
                            {"global_share", 0.1},
                            {"seed", static_cast<std::int64_t>(seed)}};
    isolated([&] {
      const auto outcome = run_soak(topology, settings, faults);
      const auto& row = outcome.rows.at(0);
      EXPECT_EQ(get_number(row, "duplicated"), 0);
      EXPECT_EQ(get_number(row, "misdelivered"), 0);
      EXPECT_EQ(
          get_number(row, "delivered") + get_number(row, "returned") + get_number(row, "lost"),
          get_number(row, "expected"));
      EXPECT_EQ(outcome.notes.empty(), get_number(row, "lost") == 0);
      // If only links fail, a message may be lost only if neither its receiver nor its sender can
      // be reached.
      const bool may_lose = !only_links || !stays_joined(topology, faults);
      EXPECT_TRUE(may_lose || get_number(row, "lost") == 0) << to_text(outcome);
      if (testing::Test::HasFailure()) throw std::runtime_error(to_text(outcome));
      return std::string();
    });
  }
}

TEST(RouterSoak, TheNaiveRouterDeadlocksAndSaysHow) {
  const auto text = isolated([] {
    try {
      run_soak(topologies::make_topology("ring:5"), {{"method", "naive"}, {"pause_s", 1e-4}});
    } catch (const machine::Deadlock& deadlock) {
      return std::string(deadlock.what());
    }
    return std::string("no deadlock");
  });
  EXPECT_NE(text.find("router on p0 waits for out on p0 > p"), std::string::npos) << text;
  EXPECT_NE(text.find("cycle"), std::string::npos) << text;
}

}  // namespace network

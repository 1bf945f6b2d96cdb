// Over random networks every message arrives once, at its place and in order, whatever the method.
#include <gtest/gtest.h>

#include <random>

#include "simulator/declare/program.hpp"
#include "tests/simulator/network/router_support.hpp"

namespace network {

namespace {

const programs::Pattern& find_pattern(const std::string& name) {
  return *std::ranges::find(programs::all_patterns(), name, &programs::Pattern::name);
}

using Settings = std::map<std::string, double, std::less<>>;

programs::Rows run_soak(const topologies::Topology& topology, const Settings& settings,
                        const std::vector<programs::PlannedFault>& faults = {}) {
  const auto& pattern = find_pattern("soak");
  const auto model = machine::load_model("t805-25");
  programs::Setup setup{model, topology, {}, nullptr, &pattern, topologies::make_routes(topology)};
  for (const auto& p : pattern.parameters) setup.parameters[p.name] = p.value;
  for (const auto& [name, value] : settings) setup.parameters.at(name) = value;
  setup.faults = faults;
  return pattern.run(setup);
}

std::string to_text(const programs::Rows& rows) {
  std::string text;
  const programs::Row row = rows.rows.at(0);
  for (const auto& [name, value] : row) text += fmt::format("{}={:a} ", name, value);
  for (const auto& note : rows.notes) text += note + "\n";
  return text;
}

double get(const programs::Rows& rows, const std::string& column) {
  for (const auto& [name, value] : rows.rows.at(0))
    if (name == column) return value;
  throw std::out_of_range(column);
}

}  // namespace

TEST(RouterSoak, RandomNetworksLoseNothing) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto topology = random_topology(static_cast<unsigned>(seed), 64);
    const Settings settings{{"method", static_cast<double>(seed % 3)},
                            {"within", static_cast<double>(random() % 2)},
                            {"buffers", 20000},
                            {"messages", 300},
                            {"message_bytes", static_cast<double>(random() % 40)},
                            {"pause_s", random() % 2 == 0 ? 2e-4 : 5e-3},
                            {"global_share", 0.1},
                            {"seed", static_cast<double>(seed)}};
    isolated([&] {
      const auto rows = run_soak(topology, settings);
      EXPECT_EQ(get(rows, "delivered"), get(rows, "expected"));
      for (const char* wrong : {"lost", "duplicated", "misdelivered", "reordered", "returned"})
        EXPECT_EQ(get(rows, wrong), 0) << wrong;
      if (testing::Test::HasFailure()) throw std::runtime_error(to_text(rows));
      return std::string();
    });
  }
}

TEST(RouterSoak, TheSameTwice) {
  for (double method = 0; method < 3; ++method) {
    const auto once = [&] {
      return isolated([&] { return to_text(run_soak(random_topology(7), {{"method", method}})); });
    };
    EXPECT_EQ(once(), once());
  }
}

// Between processors that run, all that is not delivered comes back, or is named as lost.
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
    const Settings settings{{"method", static_cast<double>(seed % 3)},
                            {"buffers", 20000},
                            {"messages", 300},
                            {"pause_s", 2e-3},
                            {"global_share", 0.1},
                            {"seed", static_cast<double>(seed)}};
    isolated([&] {
      const auto rows = run_soak(topology, settings, faults);
      EXPECT_EQ(get(rows, "duplicated"), 0);
      EXPECT_EQ(get(rows, "misdelivered"), 0);
      EXPECT_EQ(get(rows, "delivered") + get(rows, "returned") + get(rows, "lost"),
                get(rows, "expected"));
      EXPECT_EQ(rows.notes.empty(), get(rows, "lost") == 0);
      EXPECT_TRUE(!only_links || get(rows, "lost") == 0);
      if (testing::Test::HasFailure()) throw std::runtime_error(to_text(rows));
      return std::string();
    });
  }
}

TEST(RouterSoak, TheNaiveRouterDeadlocksAndSaysHow) {
  const auto text = isolated([] {
    try {
      run_soak(topologies::make_generated("ring:5"), {{"method", 3}, {"pause_s", 1e-4}});
    } catch (const machine::Deadlock& deadlock) {
      return std::string(deadlock.what());
    }
    return std::string("no deadlock");
  });
  EXPECT_NE(text.find("router on p0 waits for out on p0 > p"), std::string::npos) << text;
  EXPECT_NE(text.find("cycle"), std::string::npos) << text;
}

}  // namespace network

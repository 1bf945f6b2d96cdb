// Stopped processors and cut links. The run must always end, either with the right image or with a
// fault that names the cause.
#include <gtest/gtest.h>

#include "simulator/machine/faults.hpp"
#include "tests/simulator/iirra/iirra_support.hpp"

namespace iirra {
namespace {

constexpr unsigned LIMIT_S = 20;  // host time in s; a run takes well under one second

// Returns "right" or "wrong" for the image, or the exception thrown, such as "machine::Fault: ...".
std::string outcome(const Params& params, const std::string& topology,
                    const programs::PlannedFault& fault) {
  try {
    return isolated(
        [&] {
          auto setup = make_setup(topologies::make_topology(topology));
          setup.faults = {fault};
          const auto result = run_iirra(setup, make_glass_scene(), params);
          const auto expected = render(make_glass_scene(), params.image);
          return result.samples == expected.samples && result.rgb8 == make_rgb8(expected.samples)
                     ? "right"
                     : "wrong";
        },
        LIMIT_S);
  } catch (const test::ChildThrew& thrown) {
    return thrown.type + ": " + thrown.what();
  }
}

TEST(IirraFaults, AProcessorThatStopsIsNamed) {
  const struct {
    int processor;
    const char* name;
  } roles[] = {{0, "coordinator"}, {8, "display"}, {4, "worker4"}, {1, "worker1"}};
  for (const auto& [processor, name] : roles)
    for (const double at_s : {0.0, 0.05, 0.3}) {
      SCOPED_TRACE(fmt::format("{} at {} s", name, at_s));
      const auto told = outcome(small_params(), "mesh:3x3", {at_s, processor, -1});
      EXPECT_TRUE(told.starts_with(fmt::format("machine::Fault: {} stopped at ", name))) << told;
    }
}

// Each balancing method has message types of its own. All of them must be routed around the cut
// link.
TEST(IirraFaults, ACutLinkIsGoneAround) {
  for (int balance = 0; balance < 7; ++balance)
    for (const std::uint64_t seed : {1, 2, 3}) {
      std::mt19937_64 random(seed + 100 * static_cast<std::uint64_t>(balance));
      const std::string topology = seed % 2 ? "mesh:3x3" : "ring:6";
      const auto links = topologies::make_topology(topology).links;
      const auto& link = links[random() % links.size()];
      auto params = small_params();
      params.balance = static_cast<BalanceMethod>(balance);
      params.is_polled = random() % 2;
      params.start = static_cast<Start>(random() % 3);
      constexpr network::Method METHODS[] = {network::Method::green, network::Method::chalmers,
                                             network::Method::acyclic};
      params.method = METHODS[random() % 3];
      params.stages = {Limits{}, Limits{}};
      params.stages[0].min_cell = 4;
      const double at_s = static_cast<double>(random() % 400) / 1000;
      SCOPED_TRACE(
          fmt::format("seed {}, balance {}, start {}, polled {}, method {}, {}: {} - {} at {} s",
                      seed, balance, int(params.start), params.is_polled, int(params.method),
                      topology, link.a.processor, link.b.processor, at_s));
      EXPECT_EQ(outcome(params, topology, {at_s, link.a.processor, link.b.processor}), "right");
    }
}

// The cut leaves no other route. A part of the picture is therefore missing, or some workers do not
// learn that the run ends. The run must end with a fault or deadlock that names a processor.
TEST(IirraFaults, ACutLinkWithoutAnotherWayIsTold) {
  for (int balance = 0; balance < 7; ++balance)
    for (const std::uint64_t seed : {1, 2, 3}) {
      std::mt19937_64 random(seed + 100 * static_cast<std::uint64_t>(balance));
      auto params = small_params();
      params.balance = static_cast<BalanceMethod>(balance);
      params.is_polled = random() % 2;
      const int from = static_cast<int>(random() % 4);
      const double at_s = 0.02 + static_cast<double>(random() % 300) / 1000;
      SCOPED_TRACE(fmt::format("seed {}, balance {}, polled {}: {} - {} at {} s", seed, balance,
                               params.is_polled, from, from + 1, at_s));
      const auto told = outcome(params, "line:5", {at_s, from, from + 1});
      EXPECT_TRUE(told.starts_with("machine::Fault: ") || told.starts_with("machine::Deadlock: "))
          << told;
      EXPECT_TRUE(told.find("processor ") != told.npos || told.find("worker") != told.npos ||
                  told.find("display") != told.npos || told.find("coordinator") != told.npos)
          << told;
    }
}

TEST(IirraFaults, ACutAfterTheEndChangesNothing) {
  EXPECT_EQ(outcome(small_params(), "line:5", {500, 1, 2}), "right");
}

TEST(IirraFaults, ALimitOfTimeEndsWithWhatThereIs) {
  run_isolated([] {
    observe::RunMonitor monitor;
    monitor.until = machine::Seconds{0.3};
    auto setup = make_setup(topologies::make_topology("mesh:3x3"));
    setup.monitor = &monitor;
    const auto result = run_iirra(setup, make_glass_scene(), small_params());
    EXPECT_EQ(result.end, machine::End::limit);
    EXPECT_NEAR(result.setup_s + result.time_s, 0.3, 1e-12);
    EXPECT_GT(result.counts.samples, 0u);
  });
}

}  // namespace
}  // namespace iirra

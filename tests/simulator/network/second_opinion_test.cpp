// Compares networks of the machine with an independent simulation, and both with queueing theory.
#include "tests/simulator/network/second_opinion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "simulator/programs/network/traffic.hpp"
#include "tests/simulator/programs/run_program.hpp"
#include "tests/support/lab.hpp"
#include "topologies/graph/metrics.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace programs {
namespace {

// Length of a packet; its time on a link is no multiple of 1 us.
constexpr std::uint64_t BYTES = 97;

machine::Model make_ideal_model() {
  return machine::override_model("t805-25",
                                 {{"cpu.clock", 1e12},
                                  {"memory.steal_word", 0.0},
                                  {"link.both_ways_rate", "2 * link.one_way_rate"}},
                                 "the test");
}

double service_of(const machine::Model& model) {
  return static_cast<double>(BYTES) / model.link.one_way_rate;
}

// Returns the latency of each packet in seconds, in the order of `arrivals`.
std::vector<double> run_machine_on(const topologies::Topology& topology,
                                   const std::vector<Arrival>& arrivals) {
  return occam::isolated_numbers([&] {
    const auto model = make_ideal_model();
    std::vector<double> latencies;
    for (const auto& d : run_traffic(Setup{model, topology}, arrivals, BYTES).deliveries)
      latencies.push_back(d.received_s - d.sent_s);
    return latencies;
  });
}

std::vector<double> ask_second_opinion(const topologies::Topology& topology,
                                       const std::vector<Arrival>& arrivals) {
  const auto routes = make_routes(topology);
  const auto around = neighbours(topology);
  std::vector<second_opinion::Packet> packets;
  for (const auto& a : arrivals)
    packets.push_back({1e-6 * static_cast<double>(a.at_us), a.from, a.to});
  auto latencies =
      second_opinion::Network(packets, service_of(make_ideal_model()), [&](int from, int to) {
        const int port = routes.next_port(from, to);
        return std::ranges::find(around[from], port, &topologies::Neighbour::port)->processor;
      }).run();
  for (std::size_t i = 0; i < latencies.size(); ++i) latencies[i] -= packets[i].at_s;
  return latencies;
}

double mean_of(std::span<const double> numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}

// The number of packets per second from each processor at which the busiest link is saturated.
double saturating_rate(const topologies::Topology& topology) {
  const auto busiest = eval_metrics(topology).all_to_all.messages;
  return (topology.processors - 1) / static_cast<double>(busiest) / service_of(make_ideal_model());
}

struct Case {
  std::string topology;
  double share;  // fraction of the saturating rate
  double window_us;
};

class SecondOpinion : public testing::TestWithParam<Case> {};

// Both simulations send the same packets on the same routes at the same dates. They differ only in
// the time that a processor takes: a fraction of a nanosecond in the simulated machine, none in the
// other simulation.
TEST_P(SecondOpinion, AgreesOnTheMeanLatencyOfUniformTraffic) {
  const auto& [name, share, window_us] = GetParam();
  const auto topology = topologies::make_topology(name);
  for (const std::uint64_t seed : {1, 2}) {
    const auto arrivals = make_uniform_traffic(topology.processors,
                                               share * saturating_rate(topology), window_us, seed);
    const double found = mean_of(run_machine_on(topology, arrivals));
    const double expected = mean_of(ask_second_opinion(topology, arrivals));
    EXPECT_NEAR(found, expected, 1e-4 * expected)
        << name << ", load " << share << ", seed " << seed << ", " << arrivals.size() << " packets";
  }
}

INSTANTIATE_TEST_SUITE_P(Traffic, SecondOpinion,
                         testing::Values(Case{"line:8", 0.1, 1e6}, Case{"line:8", 0.5, 4e5},
                                         Case{"line:8", 0.9, 3e5}, Case{"mesh:4x4", 0.1, 3e5},
                                         Case{"mesh:4x4", 0.5, 1e5}, Case{"mesh:4x4", 0.9, 1e5},
                                         Case{"mesh:8x8", 0.1, 1e5}, Case{"mesh:8x8", 0.5, 3e4},
                                         Case{"mesh:8x8", 0.9, 3e4}),
                         [](const auto& at) {
                           std::string name = fmt::format("{}_{:.0f}percent", at.param.topology,
                                                          100 * at.param.share);
                           std::ranges::replace(name, ':', '_');
                           return name;
                         });

// A link with Poisson arrivals and a constant service time s is an M/D/1 queue. With load rho, a
// packet waits rho s / (2 (1 - rho)) on average (formula of Pollaczek and Khinchine).
TEST(QueueingTheory, APacketWaitsAsInAnMD1Queue) {
  const double service_s = service_of(make_ideal_model());
  const auto topology = topologies::make_topology("line:2");
  for (const double rho : {0.3, 0.6, 0.8}) {
    const std::uint64_t seed = 7;
    auto arrivals = make_uniform_traffic(2, rho / service_s, 8e6, seed);
    std::erase_if(arrivals, [](const Arrival& a) { return a.from != 0; });
    const auto latencies = run_machine_on(topology, arrivals);
    // Estimates the error of the mean from the means of long batches, which are nearly independent.
    constexpr std::size_t BATCHES = 20;
    const std::size_t length = latencies.size() / BATCHES;
    std::vector<double> waits;
    for (std::size_t b = 0; b < BATCHES; ++b) {
      const auto batch = std::span(latencies).subspan(b * length, length);
      waits.push_back(mean_of(batch) - service_s);
    }
    const double wait = mean_of(waits);
    double squares = 0;
    for (const double w : waits) squares += (w - wait) * (w - wait);
    const double error = std::sqrt(squares / (BATCHES * (BATCHES - 1)));
    const double expected = rho * service_s / (2 * (1 - rho));
    EXPECT_LT(error, 0.05 * expected) << "rho " << rho << ", seed " << seed;
    EXPECT_NEAR(wait, expected, 3 * error) << "rho " << rho << ", seed " << seed;
  }
}

// The program must report if its queues grow without bound.
TEST(QueueingTheory, ASaturatedNetworkSaysSo) {
  const auto model = make_ideal_model();
  const auto topology = topologies::make_topology("mesh:4x4");
  const double full = saturating_rate(topology) * service_of(model);
  for (const double share : {0.1, 0.9, 1.2, 3.0}) {
    const auto found = occam::isolated_numbers([&] {
      const auto outcome =
          run_program("traffic", programs::Setup{model, topology},
                      {{"bytes", static_cast<std::int64_t>(BYTES)}, {"load", share * full}});
      return occam::Numbers{get_number(outcome.rows.at(0), "saturated"),
                            outcome.is_saturated ? 1.0 : 0.0};
    });
    EXPECT_EQ(found, occam::Numbers(2, share > 1 ? 1 : 0)) << share << " of the saturating load";
  }
}

}  // namespace
}  // namespace programs

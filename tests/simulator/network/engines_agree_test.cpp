// Random machines with routers, either saturated or with faults. Links with and without SimGrid
// must give equal measurements.
#include <gtest/gtest.h>

#include <random>

#include "simulator/machine/faults.hpp"
#include "tests/simulator/network/router_support.hpp"
#include "tests/simulator/programs/run_program.hpp"

namespace network {
namespace {

using occam::isolated_numbers;
using occam::Numbers;
using programs::Settings;

constexpr const char* ALL_METHODS[] = {"naive", "chalmers", "green", "acyclic"};
constexpr int FEWEST = 4, MOST = 200;  // number of processors

struct Trial {
  const char* program;
  Settings settings;
  programs::Setup setup;
};

topologies::Topology make_network(std::uint64_t seed) {
  for (auto number = static_cast<unsigned>(seed);; number += 1000) {
    const int largest = seed % 8 == 0 ? MOST : MOST / 5;  // most machines are small, to save time
    auto topology = random_topology(number, largest);
    if (topology.processors >= FEWEST) return topology;
  }
}

// Chooses links and processors that fail during the soak test (random messages for a long time).
std::vector<programs::PlannedFault> plan_faults(const topologies::Topology& topology,
                                                std::mt19937_64& random) {
  std::vector<programs::PlannedFault> faults;
  const auto pick_date_s = [&] { return 1e-4 * static_cast<double>(random() % 300); };
  for (std::uint64_t i = random() % 4; i > 0; --i) {
    const auto& link = topology.links[random() % topology.links.size()];
    faults.push_back({pick_date_s(), link.a.processor, link.b.processor});
  }
  if (random() % 2 == 0)
    faults.push_back(
        {pick_date_s(), static_cast<int>(random() % static_cast<unsigned>(topology.processors))});
  return faults;
}

// Makes a trial: a soak test with faults, or a load from light to several times the routers'
// capacity.
Trial make_trial(const machine::Model& model, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Trial trial{"soak", {}, {model, make_network(seed)}};
  trial.setup.routes = topologies::make_routes(trial.setup.topology);
  trial.settings = {{"method", ALL_METHODS[seed / 2 % 4]},
                    {"buffers", std::int64_t{20000}},
                    {"seed", static_cast<std::int64_t>(seed)}};
  const auto add = [&](const Settings& more) { trial.settings.insert(more.begin(), more.end()); };
  if (seed % 2 == 0) {
    trial.setup.faults = plan_faults(trial.setup.topology, random);
    add({{"messages", std::int64_t{300}},
         {"pause_s", random() % 2 == 0 ? 1e-5 : 2e-3},
         {"global_share", 0.1}});
  } else {
    trial.program = "router_load";
    const auto bytes = static_cast<std::int64_t>(4 + random() % 100);
    add({{"message_bytes", bytes},
         {"load", 0.05 * static_cast<double>(1 + random() % 12)},
         {"warm_up_s", 1e-3},
         {"window_s", 4e-3}});
  }
  return trial;
}

// Returns the measurements of the program, or the date of the deadlock if there is one.
Numbers measure(Trial trial, machine::Links links) {
  return isolated_numbers([&] {
    trial.setup.engine.links = links;
    Numbers numbers;
    try {
      const auto outcome = programs::run_program(trial.program, trial.setup, trial.settings);
      for (const auto& [name, cell] : outcome.rows.at(0)) {
        if (const auto* number = std::get_if<double>(&cell)) numbers.push_back(*number);
        if (const auto* number = std::get_if<std::int64_t>(&cell))
          numbers.push_back(static_cast<double>(*number));
      }
    } catch (const machine::Deadlock& deadlock) {
      numbers.push_back(deadlock.when.value);
    }
    return numbers;
  });
}

TEST(EnginesAgree, OnRandomMachinesOfRouters) {
  const auto model = machine::load_model("t805-25");
  // The environment variable TLAB_MACHINES sets the number of random machines, for instance 200.
  // The default is small.
  const char* asked = std::getenv("TLAB_MACHINES");
  const int machines = asked ? std::stoi(asked) : 24;
  for (int seed = 1; seed <= machines; ++seed) {
    const Trial trial = make_trial(model, static_cast<std::uint64_t>(seed));
    const Numbers simgrid = measure(trial, machine::Links::simgrid);
    const Numbers direct = measure(trial, machine::Links::direct);
    ASSERT_FALSE(simgrid.empty());
    ASSERT_EQ(simgrid.size(), direct.size()) << "seed " << seed;
    for (std::size_t i = 0; i < simgrid.size(); ++i)
      EXPECT_NEAR(simgrid[i], direct[i], 1e-12 * std::abs(simgrid[i]))
          << "seed " << seed << ", " << trial.program << " on " << trial.setup.topology.processors
          << " processors, number " << i;
  }
}

}  // namespace
}  // namespace network

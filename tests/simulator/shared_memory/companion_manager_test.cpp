// Data managers on processors of their own, compared with managers on the processor of the
// application.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"
#include "tests/support/lab.hpp"
#include "topologies/make/generators.hpp"

namespace shared_memory {
namespace {

constexpr int NODES = 4, ITEMS = 40;
constexpr std::uint64_t ITEM = 40;  // size of an item in bytes

machine::Model make_model(double access, double look_up) {
  return machine::override_model("t805-25",
                                 {{"operation.data_access", access},
                                  {"operation.data_looked_up", look_up},
                                  {"software.idle_period", 0.0}},
                                 "tests");
}

// Data use of a processor's application, and the date of its end.
struct Done {
  DataUse use;
  double end_s = 0;
};

using Application = std::function<void(int id, DataManager&)>;

// A line whose first processor serves data. If `is_double`, the other applications run on
// companions.
struct Line {
  Line(const machine::Model& model, bool is_double, Scheme scheme, const Application& application)
      : machine(model), catalogue(make_catalogue(ITEMS, ITEM)) {
    std::vector<machine::Processor*> applications, companions(NODES);
    for (int id = 0; id < NODES; ++id)
      applications.push_back(&machine.add_processor(fmt::format("p{}", id), 1 << 20));
    network::Params params;
    params.processes.assign(NODES, {1});
    if (is_double)
      for (int id = 1; id < NODES; ++id) {
        applications[id] = companions[id] =
            &machine.add_companion(*applications[id], fmt::format("p{}.second", id));
        params.processes[id] = {1, 2};
      }
    params.companions.assign(companions.begin(), companions.end());
    const auto topology = topologies::make_line(NODES);
    network.emplace(
        machine, network::make_routing(params.method, topology, topologies::make_routes(topology)),
        params);
    DataParams data;
    data.scheme = scheme;
    data.cache_bytes = 10 * ITEM;
    data.server_cache_bytes = ITEMS * ITEM;
    data.page_items = 2;
    memory.emplace(machine, *network, catalogue, data, 0, companions);
    done.resize(NODES);
    for (int id = 0; id < NODES; ++id)
      applications[id]->start(fmt::format("application {}", id), machine::Priority::low, [&, id] {
        auto& manager = memory->manager(id);
        if (id > 0) application(id, manager);
        done[id] = {manager.use(), machine::this_process().now().value};
        manager.serve_for_ever();
      });
    machine.run();
  }

  machine::Machine machine;
  Catalogue catalogue;
  std::optional<network::Network> network;
  std::optional<VirtualMemory> memory;
  std::vector<Done> done;
};

// Makes accesses that favour some items, with computations between them.
void make_accesses(int id, DataManager& manager) {
  base::Random random(1, static_cast<std::uint64_t>(id));
  for (int i = 0; i < 300; ++i) {
    manager.access({0, static_cast<int>(ITEMS * random.uniform() * random.uniform())});
    machine::this_process().charge(machine::Cycles{static_cast<int>(2000 * random.uniform())});
  }
}

// Whenever a record arrives, the cache's LRU list must be the same as on a single processor, so
// that as many accesses are found locally as there. This must hold even if updating the list takes
// much longer than finding a record.
TEST(CompanionManager, FindsLocallyWhatOneProcessorFinds) {
  for (const auto scheme : {Scheme::items, Scheme::pages})
    for (const auto& [access, look_up] : {std::pair(8500.0, 4250.0), {20e3, 100.0}}) {
      SCOPED_TRACE(fmt::format("scheme {} access {}", static_cast<int>(scheme), access));
      const auto model = make_model(access, look_up);
      const auto measure = [&](bool is_double) {
        return occam::isolated_numbers([&] {
          Line run(model, is_double, scheme, make_accesses);
          occam::Numbers numbers;
          double end_s = 0;
          for (int id = 1; id < NODES; ++id) {
            numbers.push_back(static_cast<double>(run.done[id].use.found_at(Level::local)));
            end_s = std::max(end_s, run.done[id].end_s);
          }
          const auto use = run.memory->use();
          EXPECT_EQ(use.accesses(), 300u * (NODES - 1));
          EXPECT_EQ(use.found_at(Level::local) + use.requests, use.accesses());
          numbers.push_back(end_s);
          return numbers;
        });
      };
      auto single = measure(false), twice = measure(true);
      if (access == 8500) {
        EXPECT_LT(twice.back(), single.back());
      }
      single.pop_back();
      twice.pop_back();
      EXPECT_EQ(twice, single);
    }
}

// Accesses come faster than the list is updated, so the application must wait for room in the
// queue.
TEST(CompanionManager, TheQueueOfAccessesHasABound) {
  constexpr int ACCESSES = 300, MOST = 65;
  const auto found = occam::isolated_numbers([] {
    Line run(make_model(20e3, 100), true, Scheme::items, [](int /*id*/, DataManager& manager) {
      for (int i = 0; i <= ACCESSES; ++i) manager.access({0, 5});
    });
    return occam::Numbers{run.done[1].end_s, static_cast<double>(run.done[1].use.accesses())};
  });
  EXPECT_EQ(found.at(1), ACCESSES);  // number of local accesses; one more access is a request
  EXPECT_GT(found.at(0), (ACCESSES - MOST) * 19'900 / 25e6);
}

// Processor 1 of the line has the item, and computes for 1 s. Processor 2 requests the item. It
// must receive the item after this computation, or at once if processor 1 has a companion.
TEST(CompanionManager, ServesWhileTheApplicationComputes) {
  const auto measure = [&](bool is_double) {
    return occam::isolated_numbers([&] {
      const auto compute = [](double s) { machine::this_process().charge(machine::Seconds{s}); };
      Line run(make_model(8500, 4250), is_double, Scheme::items, [&](int id, DataManager& manager) {
        if (id == 1) {
          manager.access({0, 5});
          compute(1);
        }
        if (id == 2) {
          compute(0.1);
          manager.access({0, 5});
        }
      });
      const auto use = run.memory->use();
      return occam::Numbers{run.done[2].end_s, static_cast<double>(use.found_at(Level::path))};
    });
  };
  const auto single = measure(false), twice = measure(true);
  EXPECT_EQ(single.at(1), 1);
  EXPECT_EQ(twice.at(1), 1);
  EXPECT_GT(single.at(0), 1);
  EXPECT_LT(twice.at(0), 0.11);
}

}  // namespace
}  // namespace shared_memory

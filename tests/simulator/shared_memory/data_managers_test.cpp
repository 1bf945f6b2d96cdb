// Virtual shared memory on random networks: every access must get its item, under any scheme.
#include <gtest/gtest.h>

#include <random>

#include "base/errors.hpp"
#include "simulator/programs/data/data.hpp"
#include "tests/support/lab.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/make/generators.hpp"

namespace programs {
namespace {

using network::Method;
using shared_memory::Level;

constexpr std::uint64_t ITEM = 40;

// A model with fast accesses. Managers check for messages all the time, so that requests meet more
// often.
const machine::Model& model() {
  static const auto quick = machine::override_model(
      "t805-25", {{"operation.data_access", 1000.0}, {"software.idle_period", 0.0}}, "tests");
  return quick;
}

DataLoad make_load(int items, int cached, int accesses) {
  DataLoad load;
  load.items = items;
  load.item_bytes = ITEM;
  load.accesses = accesses;
  load.data.cache_bytes = load.data.server_cache_bytes = static_cast<std::uint64_t>(cached) * ITEM;
  load.network.buffers = 200;
  return load;
}

std::vector<DataPass> run_on(const topologies::Topology& topology, const DataLoad& load) {
  const auto routes = topologies::make_routes(topology);
  return run_data(Setup{model(), topology},
                  network::make_routing(load.network.method, topology, routes), load);
}

// Returns all counts, pass by pass.
occam::Numbers numbers_of(const std::vector<DataPass>& passes) {
  occam::Numbers numbers;
  for (const auto& pass : passes) {
    const auto& use = pass.use;
    numbers.insert(numbers.end(), {pass.time_s, static_cast<double>(pass.server_seen.value_or(0))});
    for (const auto count : use.found) numbers.push_back(static_cast<double>(count));
    for (const auto count :
         {use.requests, use.request_links, use.spared_by_path, use.spared_by_queue, use.seen,
          use.answered, use.queued, use.passed_on})
      numbers.push_back(static_cast<double>(count));
  }
  return numbers;
}

enum Column {
  TIME,
  SERVER,
  LOCAL,
  PATH,
  QUEUE,
  COORDINATOR,
  DISK,
  REQUESTS,
  LINKS,
  SPARED_PATH,
  SPARED_QUEUE,
  SEEN,
  ANSWERED,
  QUEUED,
  PASSED_ON,
  COLUMNS
};

occam::Numbers measure(const topologies::Topology& topology, const DataLoad& load) {
  return occam::isolated_numbers([&] { return numbers_of(run_on(topology, load)); });
}

TEST(DataManagers, EveryAccessGetsItsItem) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    auto topology = topologies::random_topology(seed);
    for (unsigned more = 1000; topology.processors > 16; ++more)
      topology = topologies::random_topology(seed + more);
    std::mt19937 random(seed);
    const int items = 5 + static_cast<int>(random() % 60);
    const auto method = std::array{Method::green, Method::chalmers, Method::acyclic}[seed % 3];
    for (const auto& [scheme, path, queue] : {std::tuple(shared_memory::Scheme::items, true, true),
                                              {shared_memory::Scheme::items, true, false},
                                              {shared_memory::Scheme::items, false, true},
                                              {shared_memory::Scheme::pages, false, false}}) {
      SCOPED_TRACE(fmt::format("seed {} scheme {} path {} queue {}", seed, static_cast<int>(scheme),
                               path, queue));
      auto load = make_load(items, 1 + static_cast<int>(random() % items), 60);
      load.network.method = method;
      load.data.scheme = scheme;
      load.data.in_path = path;
      load.data.waiting_queue = queue;
      load.data.page_items = 1;
      load.data.coordinator = topology.root;
      load.passes = 2;
      load.together = random() % 2 == 0;
      load.coordinator_too = random() % 2 == 0;
      load.seed = seed;
      const auto n = measure(topology, load);
      ASSERT_EQ(n.size(), 2u * COLUMNS);
      const bool all_access = scheme == shared_memory::Scheme::pages || load.coordinator_too;
      const int who = topology.processors - (all_access ? 0 : 1);
      for (int pass = 0; pass < 2; ++pass) {
        const double* p = &n[static_cast<std::size_t>(pass * COLUMNS)];
        EXPECT_EQ(p[LOCAL] + p[PATH] + p[QUEUE] + p[COORDINATOR] + p[DISK], 60.0 * who);
        const double own_disk = load.coordinator_too ? p[DISK] : 0;
        EXPECT_LE(std::abs(p[REQUESTS] - (p[PATH] + p[QUEUE] + p[COORDINATOR] + p[DISK])),
                  own_disk);
        if (!path) {
          EXPECT_EQ(p[SPARED_PATH] + p[SPARED_QUEUE], 0);
        }
        if (!path || !queue) {
          EXPECT_EQ(p[QUEUE] + p[QUEUED], 0);
        }
        if (scheme == shared_memory::Scheme::pages) {
          EXPECT_EQ(p[PATH], p[REQUESTS]);
        }
      }
    }
  }
}

// On a line, all requests to the coordinator at its end pass the other processors. There are few
// items, so several processors request the same item at the same time.
TEST(DataManagers, PathAndQueueSpareRequests) {
  const auto line = topologies::make_line(7);
  occam::Numbers with(COLUMNS), without_queue(COLUMNS), direct(COLUMNS);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto load = make_load(10, 10, 60);
    load.seed = seed;
    const auto add = [&](occam::Numbers& sum) {
      const auto more = measure(line, load);
      for (std::size_t i = 0; i < COLUMNS; ++i) sum[i] += more[i];
    };
    add(with);
    load.data.waiting_queue = false;
    add(without_queue);
    load.data.in_path = false;
    add(direct);
  }
  EXPECT_GT(with[SPARED_QUEUE], 0);
  EXPECT_GT(without_queue[SPARED_PATH], 0);
  EXPECT_EQ(with[QUEUE], with[QUEUED]);
  EXPECT_LT(with[SERVER], without_queue[SERVER]);
  EXPECT_LT(with[LINKS], without_queue[LINKS]);
  EXPECT_LT(without_queue[SERVER], direct[SERVER]);
  EXPECT_EQ(direct[SERVER], direct[REQUESTS]);
}

TEST(DataManagers, ACacheForAllAsksOnce) {
  auto load = make_load(50, 50, 400);
  load.passes = 2;
  const auto n = measure(topologies::make_topology("mesh:3x3"), load);
  // 400 random accesses reach every item, so each of the 8 processors requests all 50 items.
  EXPECT_EQ(n[REQUESTS], 8 * 50);
  EXPECT_EQ(n[DISK], 50);
  EXPECT_EQ(n[COLUMNS + REQUESTS], 0);
  EXPECT_EQ(n[COLUMNS + LOCAL], 8 * 400);
}

// A local access must cost a check for messages and two operations on data, and must send no
// message.
TEST(DataManagers, ALocalAccessTakesTheCalibratedTime) {
  auto load = make_load(1, 1, 1000);
  load.passes = 2;
  const auto n = measure(topologies::make_line(2), load);
  EXPECT_EQ(n[COLUMNS + LOCAL], 1000);
  const double look = (n[COLUMNS + TIME] * 25e6 - 1000 * 1000) / 1000;
  EXPECT_GT(look, 30);  // cycles of a check for messages: a PRI ALT with two guards
  EXPECT_LT(look, 200);
}

TEST(DataManagers, AreDeterministic) {
  auto load = make_load(40, 10, 100);
  load.passes = 2;
  const auto torus = topologies::make_topology("torus:3x3");
  const auto first = measure(torus, load), second = measure(torus, load);
  EXPECT_EQ(first, second);
  load.seed = 2;
  EXPECT_NE(measure(torus, load), first);
}

std::string refusal(const DataLoad& load) {
  return occam::isolated([&]() -> std::string {
    try {
      run_on(topologies::make_line(3), load);
    } catch (const base::BadInput& error) {
      return error.what();
    }
    return "";
  });
}

TEST(DataManagers, BadInputIsNamed) {
  auto small = make_load(10, 1, 1);
  small.data.cache_bytes = ITEM - 1;
  EXPECT_NE(refusal(small).find("cache_percent: found a cache of 39 bytes"), std::string::npos);
  auto server = make_load(10, 1, 1);
  server.data.server_cache_bytes = 1;
  EXPECT_NE(refusal(server).find("server_cache_percent"), std::string::npos);
  auto large = make_load(10, 1, 1);
  large.data.cache_bytes = 1ULL << 40;
  EXPECT_NE(refusal(large).find("the free memory of p1"), std::string::npos);
  auto nobody = make_load(10, 1, 1);
  nobody.data.coordinator = 3;
  EXPECT_NE(refusal(nobody).find("data.coordinator: found 3, expected 0 to 2"), std::string::npos);
  EXPECT_EQ(refusal(make_load(10, 1, 1)), "");
}

// A live view must show for each processor the numbers of its own cache.
TEST(DataManagers, EachIsShownWithItsNumbers) {
  struct Reader : observe::RunObserver {
    void begin(const machine::Machine&, const observe::ControlPanel& shown) override {
      view = shown;
    }
    void before_change(double) override {}
    void end(double) override {
      for (int processor = -1; processor <= 4; ++processor) {
        double cached = -1;
        for (const auto& inspect : view.inspections)
          for (const auto& reading : inspect(processor))
            if (reading.name == "of") cached = reading.value;
        capacities.push_back(cached);
      }
    }
    observe::ControlPanel view;
    occam::Numbers capacities;
  };
  const auto found = occam::isolated_numbers([] {
    const auto topology = topologies::make_topology("line:4");
    const auto load = make_load(40, 5, 30);
    Reader reader;
    observe::RunMonitor monitor;
    monitor.observer = &reader;
    programs::Setup setup{model(), topology};
    setup.monitor = &monitor;
    const auto routes = topologies::make_routes(topology);
    run_data(setup, network::make_routing(load.network.method, topology, routes), load);
    return reader.capacities;
  });
  EXPECT_EQ(found, (occam::Numbers{-1, 5 * ITEM, 5 * ITEM, 5 * ITEM, 5 * ITEM, -1}));
}

}  // namespace
}  // namespace programs

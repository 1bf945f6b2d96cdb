// The farm: on any machine, its picture must equal that of the sequential renderer.
#include "simulator/farm/farm.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "renderer/scene/generators.hpp"
#include "simulator/machine/faults.hpp"
#include "tests/simulator/farm/farm_support.hpp"
#include "topologies/make/generators.hpp"

namespace farm {
namespace {

// Runs the farm. Returns how its picture differs from the sequential renderer's, or "" if it does
// not.
std::string compare(const std::string& topology, const renderer::Scene& scene,
                    const Params& params) {
  return isolated([&]() -> std::string {
    const auto oracle = renderer::render(scene, params.image);
    const auto farm = run_farm(
        {machine::load_model("t805-25"), topologies::make_topology(topology)}, scene, params);
    if (!(farm.rays == oracle.rays))
      return fmt::format("{} rays, not {}", farm.rays.total(), oracle.rays.total());
    return farm.samples == oracle.samples ? "" : "other samples";
  });
}

TEST(Farm, ImageEqualsTheSequentialRenderersOnEveryTopology) {
  const auto glass = make_glass_scene(), spheres = renderer::make_spheres(60);
  for (const char* topology : {"tree:1", "tree:4", "tree:7", "line:1", "line:4", "line:7", "ring:4",
                               "ring:7", "mesh:1x1", "mesh:2x2", "mesh:1x7", "mesh:3x3",
                               "torus:3x3", "hypercube:3", "hypercube:4", "star:4", "tree:20:2"}) {
    EXPECT_EQ(compare(topology, glass, small_params()), "") << topology;
    EXPECT_EQ(compare(topology, spheres, small_params()), "") << topology;
  }
}

// Workers of two processor models share the tasks. The faster ones must do proportionally more.
TEST(Farm, MixedMachinesShareTheWorkBySpeed) {
  EXPECT_EQ(
      isolated([]() -> std::string {
        const auto scene = renderer::make_spheres(200);
        auto params = small_params();
        params.image.width = params.image.height = 64;  // enough tasks for an accurate ratio
        const auto slow = std::make_shared<const machine::Model>(machine::load_model("t800-20"));
        auto star = topologies::make_topology("star:4");
        star.links.push_back({{0, topologies::free_port(star, 0)}, {3, 2}});
        const auto farm = run_farm({.model = machine::load_model("t805-30"),
                                    .topology = star,
                                    .others = {{0, slow}, {3, slow}}},
                                   scene, params);
        const auto oracle = renderer::render(scene, params.image);
        if (!(farm.samples == oracle.samples)) return "other samples";
        std::uint64_t sum = 0;
        std::map<std::string, double> of;
        for (const auto& cpu : farm.use.cpus) {
          sum += cpu.tasks.value_or(0);
          of[cpu.model] += has_role(cpu, Role::worker) ? static_cast<double>(cpu.tasks.value()) : 0;
        }
        if (sum != farm.tasks) return fmt::format("{} tasks, not {}", sum, farm.tasks);
        // There are two workers of each model. One of the slow workers also routes the rays of all
        // others, which lowers its own number of tasks.
        const double ratio = of["t805-30"] / of["t800-20"];
        return ratio > 1.45 && ratio < 1.75 ? "" : fmt::format("{} times as much", ratio);
      }),
      "");
}

// Settings of the user change the order of rays, but must not change the picture.
TEST(Farm, ImageDoesNotDependOnLimitsOrdersSeedsOrCells) {
  const auto scene = make_glass_scene();
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    std::mt19937_64 random(seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Params params = small_params();
    params.seed = random();
    params.max_cell = 1 << random() % 6;
    params.stages.clear();
    for (auto n = 1 + random() % 4; n > 0; --n) params.stages.push_back(random_limits(random));
    machine::Seconds at{0};
    for (auto n = random() % 4; n > 0; --n) {
      at += {static_cast<double>(random() % 1000) * 1e-3};
      Order order{at, NonInteractive{}};
      if (random() % 3 != 0) order.what = random_limits(random);
      params.script.push_back(order);
    }
    EXPECT_EQ(compare(fmt::format("tree:{}", 1 + random() % 9), scene, params), "");
  }
}

// The order is for the time 0.05 s. The transfer of the scene takes longer than that. The order
// must still take effect 0.05 s after the first task.
TEST(Farm, OrdersCountFromTheFirstTask) {
  run_isolated([] {
    Params params = small_params();
    params.scene_message = 1;
    params.script = {{{0.05}, {NonInteractive{}}}};
    const auto r = run_farm({machine::load_model("t805-25"), topologies::make_topology("tree:3")},
                            make_glass_scene(), params);
    EXPECT_GT(r.setup_s, 0.05);
    EXPECT_GT(r.time_s, 0.1);
    EXPECT_NEAR(r.interactive_s, 0.05, 0.005);
  });
}

// Only the second order can be executed. Notes must name the others and say why they had no effect.
TEST(Farm, OrdersWithoutAnEffectAreNamed) {
  run_isolated([] {
    Params params = small_params();
    params.script = {{{0}, {Limits{}}},
                     {{0}, {NonInteractive{}}},
                     {{0}, {NonInteractive{}}},
                     {{1000}, {Limits{}}}};
    const auto r = run_farm({machine::load_model("t805-25"), topologies::make_topology("tree:3")},
                            make_glass_scene(), params);
    ASSERT_EQ(r.notes.size(), 3u);
    EXPECT_EQ(r.notes[0], "order 1 had no effect: its limits were already set");
    EXPECT_EQ(r.notes[1], "order 3 had no effect: the interactive phase was already over");
    EXPECT_EQ(r.notes[2],
              fmt::format("order 4 had no effect: the program had ended at {:.4g} s", r.time_s));
  });
}

TEST(Farm, TwoRunsAreTheSameToTheLastBit) {
  const auto scene = renderer::make_spheres(60);
  auto run = [&] {
    return isolated([&] {
      const auto r = run_farm({machine::load_model("t805-25"), topologies::make_topology("tree:5")},
                              scene, small_params());
      std::string text = fmt::format("{:a} {:a} {}", r.time_s, r.setup_s, r.events);
      for (const auto& cpu : r.use.cpus) text += fmt::format(" {:a}", cpu.busy_s);
      for (const auto& link : r.use.links) text += fmt::format(" {:a} {}", link.busy_s, link.bytes);
      return text;
    });
  };
  EXPECT_EQ(run(), run());
}

// The measured period must begin with the first task, after the transfer of the scene.
TEST(Farm, UseDoesNotCountTheScene) {
  const auto bytes_with = [](std::uint32_t scene_message) {
    return isolated([&] {
      auto params = small_params();
      params.scene_message = scene_message;
      const auto r = run_farm({machine::load_model("t805-25"), topologies::make_topology("line:1")},
                              make_glass_scene(), params);
      std::string bytes;
      for (const auto& link : r.use.links)
        bytes += fmt::format("{} to {}: {}\n", link.from, link.to, link.bytes);
      return bytes;
    });
  };
  EXPECT_EQ(bytes_with(64), bytes_with(0));
}

// Each task is a ray. The answer contains the ray, and also the hit if there is one.
TEST(Farm, MissesAreShorterThanHits) {
  run_isolated([] {
    const auto scene = renderer::parse_scene(
        "v\nfrom 0 -4 0\nat 0 0 0\nup 0 0 1\nangle 40\nhither 0.01\nresolution 24 24\n"
        "f 1 1 1 1 0 0 0 0\ns 0 0 0 1\n",
        "a sphere");
    auto params = small_params();
    params.image.limits.depth = 1;
    const auto model = machine::load_model("t805-25");
    const auto r = run_farm({model, topologies::make_topology("line:1")}, scene, params);
    ASSERT_EQ(r.rays.total(), r.rays.primary);
    ASSERT_LT(r.rays.primary_hit, r.rays.primary);
    ASSERT_GT(r.rays.primary_hit, 0u);
    const auto bytes = [&](const std::string& from, const std::string& to) {
      for (const auto& link : r.use.links)
        if (link.from == from && link.to == to) return link.bytes;
      return std::uint64_t{0};
    };
    const auto rays = get_bytes(model, "ray") * r.rays.primary;
    EXPECT_EQ(bytes("coordinator", "worker1"), rays);
    EXPECT_EQ(bytes("worker1", "coordinator"), rays + get_bytes(model, "hit") * r.rays.primary_hit);
  });
}

// Eq 4.24 and 4.25 of the thesis. The number of rays in the farm must not exceed the number of
// buffers: a worker has one in its router, one in each sender, two in its application and one in
// its results router; the coordinator has one in its sender. The number of waiting shadow feelers
// must not exceed the number that these rays can create.
TEST(Farm, RaysInFarmAndFeelersAreBounded) {
  for (int workers : {1, 2, 5, 13}) {
    const std::size_t buffers = 1 + static_cast<std::size_t>(workers) * 4 +
                                // A sender has a buffer for each child.
                                static_cast<std::size_t>(workers - 1);
    run_isolated([&] {
      const auto r = run_farm({machine::load_model("t805-25"),
                               topologies::make_topology(fmt::format("tree:{}", workers))},
                              renderer::make_spheres(60), small_params());
      const std::size_t lights = 3;
      EXPECT_LE(r.peak_tasks_in_farm, buffers) << workers;
      EXPECT_LE(r.peaks.feelers, (r.peak_tasks_in_farm + 1) * lights) << workers;
    });
  }
}

// More workers must not be slower as long as the coordinator is not the bottleneck. The speed-up
// must not exceed the number of workers.
TEST(Farm, SpeedUpGrowsAndStaysBelowTheNumberOfWorkers) {
  const auto scene = renderer::make_spheres(400);
  auto time = [&](int workers) {
    return std::stod(isolated([&] {
      return fmt::format("{:.17g}",
                         run_farm({machine::load_model("t805-25"),
                                   topologies::make_topology(fmt::format("tree:{}", workers))},
                                  scene, small_params())
                             .time_s);
    }));
  };
  const double one = time(1), two = time(2), four = time(4);
  EXPECT_LT(two, one);
  EXPECT_LT(four, two);
  EXPECT_LE(one / two, 2.0);
  EXPECT_LE(one / four, 4.0);
  EXPECT_GT(one / four, 3.0);
}

struct Refusal {
  const char* topology;
  std::uint64_t memory;
  const char* type;
  const char* message;
};

TEST(Farm, FaultsSayWhoAndWhat) {
  for (const auto& [topology, memory, type, message] : {
           Refusal{"tree:2", 140'000, "machine::OutOfMemory",
                   "worker1 is out of memory at 0.000000 s: the scene's objects"},
           Refusal{"tree:2", 100, "machine::OutOfMemory",
                   "the program asked for 131072 bytes, 100 of 100 are available"},
           Refusal{"star:5", 1 << 22, "base::BadInput", "the root uses all four ports"},
           Refusal{"tree:1", 0, "machine::OutOfMemory",
                   "the initial rays asked for 2147420880 bytes, 25034752 of"},
       }) {
    try {
      isolated([&, topology = topology, memory = memory] {
        Params params = small_params();
        if (memory > 0)
          params.worker_memory = memory;
        else
          params.image.width = params.image.height = 5181;
        run_farm({machine::load_model("t805-25"), topologies::make_topology(topology)},
                 renderer::make_spheres(400), params);
        return std::string();
      });
      ADD_FAILURE() << topology << " ran";
    } catch (const test::ChildThrew& threw) {
      EXPECT_EQ(threw.type, type) << topology;
      EXPECT_NE(std::string(threw.what()).find(message), std::string::npos) << threw.what();
    }
  }
}

// Messages of the farm are not sent around a cut link. If the farm has not finished before the cut,
// it waits for the lost workers. It must then end in a deadlock.
TEST(Farm, ACutLinkIsADeadlockUnlessTheFarmIsOver) {
  const auto run_cut = [](double at_s) {
    return isolated([&] {
      const auto result = run_farm({.model = machine::load_model("t805-25"),
                                    .topology = topologies::make_topology("tree:2"),
                                    .faults = {{.at_s = at_s, .a = 0, .b = 1}}},
                                   renderer::make_spheres(4), small_params());
      return fmt::format("{}", result.time_s);
    });
  };
  const auto whole = run_cut(1e6);
  EXPECT_EQ(run_cut(1e5), whole);
  try {
    run_cut(std::stod(whole) / 2);
    ADD_FAILURE() << "it ran";
  } catch (const test::ChildThrew& threw) {
    EXPECT_EQ(threw.type, "machine::Deadlock");
    EXPECT_NE(std::string(threw.what()).find("worker2"), std::string::npos) << threw.what();
  }
}

// The initial rays fit into the memory of the database, but their child rays do not.
TEST(Farm, TheDatabaseCanRunOutOfMemory) {
  try {
    isolated([] {
      Params params = small_params();
      // Memory for the program and for the initial rays.
      params.database_memory = 131072 + 80 * 24 * 18;
      run_farm({machine::load_model("t805-25"), topologies::make_topology("tree:1")},
               renderer::make_spheres(60), params);
      return std::string();
    });
    ADD_FAILURE() << "it ran";
  } catch (const test::ChildThrew& threw) {
    EXPECT_EQ(threw.type, "machine::OutOfMemory");
    EXPECT_NE(std::string(threw.what()).find("the ray database asked for 80 bytes, 0 of 165632"),
              std::string::npos)
        << threw.what();
  }
}

// Areas of stages and orders must be checked against the size of the picture.
TEST(Farm, AreasOfStagesAndOrdersAreWithinThePicture) {
  const auto error_of = [](const Params& params) {
    try {
      check(params);
    } catch (const base::BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Limits inside, outside;
  inside.area = {20, 13, 4, 5};
  outside.area = {20, 13, 5, 5};
  const std::string expected =
      "area: found 5 x 5 at (20, 13), expected a rectangle of pixels within 24 x 18";
  for (const auto& [limits, message] : {std::pair(inside, std::string()), {outside, expected}}) {
    Params staged = small_params(), ordered = small_params(), whole = small_params();
    staged.stages = {Limits{}, limits};
    ordered.script = {{{1}, {NonInteractive{}}}, {{2}, {limits}}};
    whole.image.area = limits.area;
    EXPECT_EQ(error_of(staged), message);
    EXPECT_EQ(error_of(ordered), message);
    EXPECT_EQ(error_of(whole), message);
  }
}

}  // namespace
}  // namespace farm

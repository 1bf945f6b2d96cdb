// The farm with blocks of pixels as tasks, the transfer of the scene, and the farm's bottleneck.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "renderer/scene/generators.hpp"
#include "simulator/farm/measured.hpp"
#include "simulator/kernels/kernels.hpp"
#include "tests/simulator/farm/farm_support.hpp"
#include "topologies/make/generators.hpp"

namespace farm {
namespace {

Params block_params(int width, int height) {
  Params params = small_params();
  params.block = Block{width, height};
  return params;
}

Result run(const Params& params, const std::string& topology, const renderer::Scene& scene) {
  return run_farm({machine::load_model("t805-25"), topologies::make_topology(topology)}, scene,
                  params);
}

TEST(FarmBlocks, ImageAndRaysEqualTheSequentialRenderers) {
  const auto scene = make_glass_scene();
  const std::uint64_t seed = 4711;
  std::mt19937_64 random(seed);
  for (const char* topology : {"tree:1", "line:4", "torus:3x3", "amp:12", "binary:7"}) {
    Params params = block_params(1 + int(random() % 30), 1 + int(random() % 30));
    if (random() % 2) params.image.area = {3, 2, 1 + int(random() % 20), 1 + int(random() % 15)};
    SCOPED_TRACE(fmt::format("{}, seed {}, blocks of {}x{}", topology, seed, params.block->width,
                             params.block->height));
    run_isolated([&] {
      const auto oracle = renderer::render(scene, params.image);
      const auto farm = run(params, topology, scene);
      EXPECT_TRUE(farm.samples == oracle.samples);
      EXPECT_TRUE(farm.rays == oracle.rays) << farm.rays.total() << ", not " << oracle.rays.total();
    });
  }
}

// Every pixel of the area must belong to exactly one block.
TEST(FarmBlocks, TileTheArea) {
  const std::uint64_t seed = 42;
  std::mt19937_64 random(seed);
  for (int round = 0; round < 200; ++round) {
    renderer::Params image;
    image.width = 1 + int(random() % 40);
    image.height = 1 + int(random() % 40);
    std::vector<int> covered(std::size_t(image.width * image.height));
    for (const auto& block : make_blocks(image, {1 + int(random() % 50), 1 + int(random() % 50)}))
      for (int y = block.y; y < block.y + block.height; ++y)
        for (int x = block.x; x < block.x + block.width; ++x)
          ++covered.at(std::size_t(y * image.width + x));
    EXPECT_EQ(covered, std::vector<int>(covered.size(), 1))
        << "seed " << seed << " round " << round;
  }
}

// If tasks are blocks, shading is the work of the worker, not of the central processors. One worker
// must be charged the cycles of all shading trees.
TEST(FarmBlocks, OneWorkerTakesTheTreesCycles) {
  const auto scene = renderer::make_spheres(100);
  run_isolated([&] {
    const auto r = run(block_params(24, 18), "tree:1", scene);
    const auto work = renderer::render(scene, small_params().image).work;
    const auto model = machine::load_model("t805-25");
    const double cycles = double(kernels::tree_costs(model)(work.counts).value);
    EXPECT_NEAR(double(r.kernel_cycles.value) / cycles, 1, 1e-6);
    EXPECT_GT(r.time_s, cycles / model.cpu.clock.value);
  });
}

TEST(FarmBlocks, WithWholePixelsThereAreNoStagesOrOrders) {
  Params staged = block_params(8, 8);
  staged.stages.push_back({});
  EXPECT_THROW(check(staged), base::BadInput);
  EXPECT_THROW(check(block_params(0, 8)), base::BadInput);
}

// If the scene is sent to the workers, the time before the first task must exceed the transfer over
// one link. The image must stay the same.
TEST(FarmScene, IsSentDownEveryLink) {
  const auto scene = renderer::make_spheres(60);
  for (const bool blocks : {false, true}) {
    Params params = blocks ? block_params(8, 8) : small_params();
    params.scene_message = 500;
    run_isolated([&] {
      const auto model = machine::load_model("t805-25");
      const auto oracle = renderer::render(scene, params.image);
      const auto farm = run(params, "tree:9", scene);
      const double least = double(object_count(scene) * get_bytes(model, "object")) /
                           model.link.one_way_rate;  // seconds over one link
      EXPECT_TRUE(farm.samples == oracle.samples);
      EXPECT_GT(farm.setup_s, least);
    });
  }
}

std::string limit_of(const Params& params, const std::string& topology, int spheres) {
  return isolated([&] {
    return find_loads(run(params, topology, renderer::make_spheres(spheres)))[0].resource;
  });
}

// The expected bottlenecks: a single worker is always busy; twelve workers with cheap rays wait for
// the coordination process; many workers with few blocks wait for the last block.
TEST(FarmBottleneck, IsWhatOthersWaitFor) {
  EXPECT_EQ(limit_of(small_params(), "tree:1", 60), "workers");
  EXPECT_EQ(limit_of(small_params(), "tree:12", 60), "coordination");
  EXPECT_EQ(limit_of(block_params(8, 9), "tree:1", 60), "workers");
  EXPECT_EQ(limit_of(block_params(8, 9), "tree:40", 60), "tasks");
}

// The database processor runs a single process. Its waiting time and the CPU's busy time must
// therefore add up to the whole time.
TEST(FarmBottleneck, WaitsFillTheTimeThatTheCpuDoesNot) {
  const auto sum = isolated([&] {
    const auto use = run(small_params(), "tree:5", renderer::make_spheres(60)).use;
    const auto& process =
        *std::ranges::find(use.processes, "database.ray.database", &observe::ProcessRow::name);
    const double waited = process.output_s + process.input_s + process.alternative_s;
    return fmt::format("{}", (waited + find_role(use, Role::database)->busy_s) / use.time_s);
  });
  EXPECT_NEAR(std::stod(sum), 1, 0.001);
}

}  // namespace
}  // namespace farm

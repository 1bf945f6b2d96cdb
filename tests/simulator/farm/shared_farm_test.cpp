// The farm with a scene that is distributed over its workers: results and times.
#include "simulator/farm/shared_farm.hpp"
#include "base/errors.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/scene/generators.hpp"
#include "simulator/farm/measured.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/machine/faults.hpp"
#include "tests/simulator/farm/farm_support.hpp"
#include "topologies/make/generators.hpp"

namespace farm {
namespace {

using farm::isolated;
using farm::run_isolated;

farm::Params small_block_params(int width, int height) {
  farm::Params params = farm::small_params();
  params.image.width = 16;
  params.image.height = 12;
  params.image.limits.depth = 3;
  params.block = farm::Block{width, height};
  return params;
}

SharedParams shared_params(double cache_percent) {
  SharedParams params;
  params.cache_percent = cache_percent;
  return params;
}

SharedResult run(const farm::Params& params, const std::string& topology,
                 const renderer::Scene& scene, const SharedParams& data) {
  return run_shared_farm({machine::load_model("t805-25"), topologies::make_topology(topology)},
                         scene, params, data);
}

std::uint64_t count_tests(const renderer::Work& work) {
  using renderer::Op;
  return work[Op::box_test] + work[Op::sphere_test] + work[Op::polygon_test] +
         work[Op::patch_test] + work[Op::cone_test];
}

std::string describe(const SharedParams& data) {
  return fmt::format("{} %, {} % at the server, {}, in path {}, waiting queue {}, method {}",
                     data.cache_percent, data.server_cache_percent,
                     data.scheme == shared_memory::Scheme::pages ? "pages" : "items", data.in_path,
                     data.waiting_queue, int(data.method));
}

// The image must equal that of the sequential renderer. For each test of a box or object by the
// sequential renderer, the farm must make one access. Each access is either local or a request.
void expect_equal(const farm::Params& params, const std::string& topology,
                  const renderer::Scene& scene, const SharedParams& data) {
  run_isolated([&] {
    const auto oracle = renderer::render(scene, params.image);
    const auto shared = run(params, topology, scene, data);
    const auto& use = shared.shared.data;
    EXPECT_TRUE(shared.farm.samples == oracle.samples);
    EXPECT_TRUE(shared.farm.rays == oracle.rays);
    EXPECT_EQ(use.accesses(), count_tests(oracle.work));
    EXPECT_EQ(use.found_at(shared_memory::Level::local) + use.requests, use.accesses());
  });
}

TEST(SharedFarm, ImageEqualsTheSequentialRenderers) {
  const std::uint64_t seed = 20261122;
  std::mt19937_64 random(seed);
  const auto glass = farm::make_glass_scene(), spheres = renderer::make_spheres(40);
  const network::Method methods[] = {network::Method::green, network::Method::chalmers,
                                     network::Method::acyclic};
  int round = 0;
  for (const char* topology : {"tree:1", "line:3", "ring:5", "torus:3x3", "amp:8", "tree:13"})
    for (const shared_memory::Scheme scheme :
         {shared_memory::Scheme::items, shared_memory::Scheme::pages})
      for (const auto method : methods) {
        const bool small = ++round % 2;
        SharedParams data = shared_params(small ? 40 + double(random() % 50) : 10);
        data.scheme = scheme;
        data.method = method;
        data.page_items = 1 + int(random() % (small ? 2 : 4));
        data.server_cache_percent = 50 + double(random() % 50);
        data.in_path = random() % 2;
        data.waiting_queue = random() % 2;
        auto params = small_block_params(1 + int(random() % 8), 1 + int(random() % 8));
        if (random() % 3 == 0) params.image.area = {3, 2, 1 + int(random() % 13), 7};
        params.image.traversal = renderer::Traversal(random() % 2);
        SCOPED_TRACE(fmt::format("seed {}, {}, {}", seed, topology, describe(data)));
        expect_equal(params, topology, small ? glass : spheres, data);
      }
}

// If every cache holds the whole scene, a worker must request each record at most once, and each
// record must be read once from the disk.
TEST(SharedFarm, OfACacheThatHoldsAllEveryRecordIsAskedForOnce) {
  const auto scene = renderer::make_spheres(60);
  run_isolated([&] {
    const auto size = ray_tracing::size_of(scene);
    const auto use = run(small_block_params(4, 4), "tree:4", scene, shared_params(100)).shared.data;
    EXPECT_LE(use.requests, 4 * (size.boxes + size.objects));
    EXPECT_LE(use.found_at(shared_memory::Level::disk), size.boxes + size.objects);
  });
}

// If requests are not offered to processors on their route (Mode::in_path_to), only the coordinator
// may answer them, and no waiting queue is used.
TEST(SharedFarm, RequestsAreAnsweredOnTheWayOnlyIfTheyAreOffered) {
  const auto scene = renderer::make_spheres(60);
  SharedParams data = shared_params(20);
  const auto expect_answers = [&](bool on_the_way, bool by_a_queue) {
    run_isolated([&] {
      const auto use = run(small_block_params(4, 4), "line:4", scene, data).shared.data;
      EXPECT_EQ(use.found_at(shared_memory::Level::path) > 0, on_the_way);
      EXPECT_EQ(use.found_at(shared_memory::Level::queue) > 0, by_a_queue);
    });
  };
  expect_answers(true, true);
  data.waiting_queue = false;
  expect_answers(true, false);
  data.in_path = false;
  expect_answers(false, false);
}

// A single worker that finds everything in its cache must take the cycles of the kernel, plus
// accesses * data_access, and little else.
TEST(SharedFarm, AnAccessTakesTheModelsCycles) {
  const auto scene = renderer::make_spheres(20);
  run_isolated([&] {
    const auto params = small_block_params(8, 6);
    const auto model = machine::load_model("t805-25");
    const auto shared = run(params, "line:1", scene, shared_params(100));
    const auto work = renderer::render(scene, params.image).work;
    const double kernel = double(kernels::tree_costs(model)(work.counts).value);
    const double accesses =
        double(count_tests(work)) * double(get_operation(model, "data_access").value);
    const double ratio = shared.farm.time_s * model.cpu.clock.value / (kernel + accesses);
    EXPECT_NEAR(double(shared.farm.kernel_cycles.value), kernel, 10);
    EXPECT_GT(ratio, 1);
    EXPECT_LT(ratio, 1.15);
  });
}

// The workers' memory is enough for the program, buffers and 10 % of the scene, but not for the
// whole scene. The shared farm must run; the ordinary farm must run out of memory.
TEST(SharedFarm, RendersWhatWorkersCannotHold) {
  const auto scene = renderer::make_spheres(800);
  auto params = small_block_params(8, 6);
  params.worker_memory = 150'000;
  expect_equal(params, "tree:4", scene, shared_params(10));
  const auto plain = isolated([&] {
    try {
      run_farm({machine::load_model("t805-25"), topologies::make_topology("tree:4")}, scene,
               params);
    } catch (const machine::OutOfMemory&) {
      return "out of memory";
    }
    return "done";
  });
  EXPECT_EQ(plain, "out of memory");
}

std::string error_of(const farm::Params& params, const SharedParams& data) {
  try {
    check(machine::load_model("t805-25"), {10, 20}, params, data);
  } catch (const base::BadInput& error) {
    return error.what();
  }
  return "none";
}

TEST(SharedFarm, NamesBadInput) {
  const auto good = small_block_params(4, 4);
  const auto expect = [&](const char* key, const farm::Params& params, const SharedParams& data) {
    const auto error = error_of(params, data);
    EXPECT_TRUE(error.starts_with(key)) << error;
  };
  EXPECT_EQ(error_of(good, shared_params(10)), "none");
  for (const double percent : {0.0, -1.0, 101.0, 1.0, std::nan("")})
    expect("data.cache_percent: found ", good, shared_params(percent));
  SharedParams server = shared_params(10);
  server.server_cache_percent = 1;
  expect("data.server_cache_percent: found a cache of", good, server);
  SharedParams pages = shared_params(10);
  pages.scheme = shared_memory::Scheme::pages;
  expect("data.cache_percent: found a cache of", good, pages);
  auto rays = good;
  rays.block.reset();
  expect("farm.task: ", rays, shared_params(10));
  auto sent = good;
  sent.scene_message = 100;
  expect("farm.scene_message_bytes: ", sent, shared_params(10));
}

TEST(SharedFarm, MemoryThatIsTooSmallIsSaid) {
  const auto scene = renderer::make_spheres(60);
  auto params = small_block_params(4, 4);
  params.worker_memory = 134'000;
  const auto found = isolated([&] {
    try {
      run(params, "tree:4", scene, shared_params(50));
    } catch (const base::BadInput& error) {
      return std::string(error.what()).find("worker1") != std::string::npos ? "said" : "unclear";
    }
    return "done";
  });
  EXPECT_EQ(found, "said");
}

TEST(SharedFarm, ARunThatIsCutShortTellsWhatWasDone) {
  const auto scene = renderer::make_spheres(60);
  const auto found = isolated([&] {
    observe::RunMonitor monitor;
    monitor.until = machine::Seconds{2};
    const auto result = run_shared_farm({.model = machine::load_model("t805-25"),
                                         .topology = topologies::make_topology("tree:3"),
                                         .monitor = &monitor},
                                        scene, small_block_params(2, 2), shared_params(30))
                            .farm;
    return fmt::format("{} {} {}", machine::to_string(result.end), result.setup_s + result.time_s,
                       farm::find_loads(result).empty());
  });
  EXPECT_EQ(found, "limit 2 false");
}

}  // namespace
}  // namespace farm

// IIRRA on nodes of two processors that share a memory: results and times.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "renderer/scene/generators.hpp"
#include "simulator/iirra/iirra.hpp"
#include "tests/support/isolated.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace iirra {
namespace {

renderer::Params make_image() {
  renderer::Params image;
  image.width = 20;
  image.height = 16;
  image.limits.depth = 3;
  return image;
}

Result run(const std::string& name, double percent, bool is_double,
           shared_memory::Scheme scheme = shared_memory::Scheme::items,
           BalanceMethod balance = BalanceMethod::neighbours) {
  const auto model = machine::load_model("t805-25");
  const auto topology = topologies::make_topology(name);
  const auto scene = renderer::make_spheres(60);
  Params params;
  params.image = make_image();
  params.max_cell = 4;
  params.is_double = is_double;
  params.balance = balance;
  if (percent > 0) {
    ray_tracing::SharedParams data;
    data.cache_percent = percent;
    data.scheme = scheme;
    params.data = make_data_params(model, ray_tracing::size_of(scene), data);
  }
  return run_iirra(
      {.model = model, .topology = topology, .routes = topologies::make_routes(topology)}, scene,
      params);
}

TEST(DoubleNode, ImageEqualsTheRenderers) {
  for (const auto scheme : {shared_memory::Scheme::items, shared_memory::Scheme::pages})
    for (const char* topology : {"line:3", "ring:5", "mesh:3x3"})
      for (const auto balance : {BalanceMethod::neighbours, BalanceMethod::coordinator})
        test::run_isolated([&] {
          SCOPED_TRACE(topology);
          const auto result = run(topology, 30, true, scheme, balance);
          const auto oracle = renderer::render(renderer::make_spheres(60), make_image());
          EXPECT_EQ(result.end, machine::End::done);
          EXPECT_TRUE(result.samples == oracle.samples);
          EXPECT_TRUE(result.rays_image == oracle.rays);
          const auto& use = result.shared->data;
          EXPECT_EQ(use.found_at(shared_memory::Level::local) + use.requests, use.accesses());
        });
}

// There is one worker, so tasks do not move, and only the work within the node differs.
TEST(DoubleNode, IsFasterThanOneProcessor) {
  const auto eval_time = [](bool is_double) {
    return test::isolated_numbers(
        [is_double] { return std::vector<double>{run("line:3", 20, is_double).time_s}; });
  };
  EXPECT_LT(eval_time(true).at(0), eval_time(false).at(0));
}

// In each node, one processor computes and counts as worker. The second processor routes messages
// and updates the LRU list of the cache.
TEST(DoubleNode, HasTwoRoles) {
  test::run_isolated([&] {
    const auto twice = run("mesh:3x3", 20, true);
    int workers = 0, routers = 0;
    for (const auto& cpu : twice.use.cpus) {
      EXPECT_LE(cpu.busy_s, twice.use.time_s * (1 + 1e-9));
      if (has_role(cpu, Role::worker)) {
        ++workers;
        EXPECT_TRUE(cpu.name.ends_with(".second")) << cpu.name;
      }
      if (!has_role(cpu, Role::router)) continue;
      ++routers;
      EXPECT_GT(cpu.busy_s - cpu.busy_high_s, 0) << "no data manager on " << cpu.name;
    }
    EXPECT_EQ(workers, 7);
    EXPECT_EQ(routers, 7);
  });
}

TEST(DoubleNode, WithoutDataManagersIsRefused) {
  EXPECT_THROW(
      try { run("mesh:3x3", 0, true); } catch (const base::BadInput& e) {
        const std::string text = e.what();
        EXPECT_TRUE(text.starts_with("iirra.node: found double")) << text;
        EXPECT_NE(text.find("data.cache_percent above 0"), std::string::npos) << text;
        throw;
      },
      base::BadInput);
}

}  // namespace
}  // namespace iirra

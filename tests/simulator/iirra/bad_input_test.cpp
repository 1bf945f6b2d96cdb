// Input that must be refused, with a message that names the key.
#include <gtest/gtest.h>

#include "tests/simulator/iirra/iirra_support.hpp"
#include "tests/topologies/support.hpp"

namespace iirra {
namespace {

std::string error_of(const Params& params, const std::string& topology = "mesh:3x3") {
  return topologies::rejection([&] { check(params, topologies::make_topology(topology)); });
}

void expect_error(const std::string& beginning, const Params& params,
                  const std::string& topology = "mesh:3x3") {
  const auto error = error_of(params, topology);
  EXPECT_TRUE(error.starts_with(beginning)) << error;
}

TEST(IirraInput, GoodInputIsTaken) {
  EXPECT_EQ(error_of(small_params()), "");
  EXPECT_EQ(error_of(small_params(), "line:3"), "");
}

TEST(IirraInput, RolesNeedThreeProcessors) {
  expect_error("network.topology: found 1 processor, expected at least 3", small_params(),
               "line:1");
  expect_error("network.topology: found 2 processors, expected at least 3", small_params(),
               "line:2");
}

TEST(IirraInput, CellsHaveTheirSizes) {
  auto params = small_params();
  for (const int cell : {-4, 0, 1, 3, 12, 1024}) {
    params.max_cell = cell;
    expect_error(fmt::format("iirra.cell: found {}, expected a power of two from 2 to 512", cell),
                 params);
  }
  params.max_cell = 32;
  expect_error("iirra.cell: found 32, expected at most the side of the image, 24 x 18 pixels",
               params);
  params.max_cell = 16;
  EXPECT_EQ(error_of(params), "");
  params.image.area = {1, 1, 12, 17};
  expect_error("iirra.cell: found 16, expected at most the side of the image, 12 x 17 pixels",
               params);
}

TEST(IirraInput, SomethingHasToWeigh) {
  const Weights none{0, 0, 0, 0, 0, 0};
  auto params = small_params();
  params.weights = none;
  expect_error("iirra.weights: found only weights of 0", params);
  params = small_params();
  params.stages[0].weights = none;
  expect_error("stage.weights: found only weights of 0", params);
  params = small_params();
  Limits ordered;
  ordered.weights = none;
  params.script = {{{1}, {ordered}}};
  expect_error("order.weights: found only weights of 0", params);
  ordered.weights = Weights{0, 0, 0, 0, 0, 1};
  params.script = {{{1}, {ordered}}};
  EXPECT_EQ(error_of(params), "");
}

TEST(IirraInput, StagesAndOrdersAreLookedAt) {
  auto params = small_params();
  params.stages.clear();
  expect_error("stage: found none", params);
  params = small_params();
  params.stages[0].area = {20, 0, 5, 5};
  EXPECT_NE(error_of(params).find("area"), std::string::npos) << error_of(params);
  params = small_params();
  params.script = {{{2}, {ray_tracing::Abort{}}}, {{1}, {ray_tracing::Abort{}}}};
  expect_error("order 2: found the time", params);
  params.script = {{{1}, {ray_tracing::Save{"a"}}}, {{2}, {ray_tracing::Save{"a"}}}};
  EXPECT_NE(error_of(params).find("\"a\""), std::string::npos) << error_of(params);
}

// On a line, a display beside the coordinator separates the coordinator from the workers. The tree
// of green balancing cannot pass the display, so this machine must be refused.
TEST(IirraInput, GreensTreeGoesRoundTheDisplay) {
  auto params = small_params();
  params.balance = BalanceMethod::green;
  params.is_far = false;
  expect_error("iirra.balance: found green, but the display (processor 1) separates workers ",
               params, "line:5");
  params.is_far = true;
  EXPECT_EQ(error_of(params, "line:5"), "");
  EXPECT_EQ(error_of(params, "tree:5"), "");
}

// run_iirra must refuse invalid input before anything runs.
TEST(IirraInput, ARunRefusesToo) {
  auto params = small_params();
  params.max_cell = 3;
  try {
    isolated([&] { return fmt::format("{}", run(params).time_s); });
    FAIL() << "it has run";
  } catch (const test::ChildThrew& thrown) {
    EXPECT_EQ(thrown.type, "base::BadInput");
    EXPECT_TRUE(std::string(thrown.what()).starts_with("iirra.cell: found 3")) << thrown.what();
  }
}

}  // namespace
}  // namespace iirra

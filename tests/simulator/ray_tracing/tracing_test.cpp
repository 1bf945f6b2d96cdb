// Tests functions that the ray tracing programs share. They make columns of results, and must
// refuse invalid input.
#include <gtest/gtest.h>

#include <map>

#include "base/errors.hpp"
#include "renderer/image/animation.hpp"
#include "simulator/ray_tracing/busy.hpp"
#include "simulator/ray_tracing/data.hpp"
#include "simulator/ray_tracing/rendering.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"
#include "tests/support/files.hpp"
#include "topologies/make/generators.hpp"

namespace ray_tracing {
namespace {

TEST(Looks, MustFitAMovingPicture) {
  const auto refusal = [](int growth, int width, int height) {
    renderer::Params image;
    image.width = width;
    image.height = height;
    return test::message_of<base::BadInput>(
        [&] { check_snapshots("farm", {.at_s = {}, .growth = growth}, image); });
  };
  constexpr int MOST = renderer::MAX_WEBP_SIDE;
  EXPECT_EQ(refusal(1, MOST, 1), "");
  EXPECT_EQ(refusal(1, 1, MOST), "");
  EXPECT_EQ(refusal(0, MOST + 1, MOST + 1), "");
  const std::string most = "pixels, expected at most 16383 pixels on each side";
  EXPECT_EQ(refusal(1, MOST + 1, 1), "farm.growth: found an image of 16384 x 1 " + most);
  EXPECT_EQ(refusal(1, 1, MOST + 1), "farm.growth: found an image of 1 x 16384 " + most);
  EXPECT_EQ(refusal(100, 1000, 1000), "");
  EXPECT_NE(refusal(1000, 1000, 1000).find("farm.growth: found 1000 pictures"), std::string::npos);
}

TEST(Looks, AreAtTimesThatAscendFrom0To1e9) {
  const auto fields = snapshot_fields();
  const auto at =
      std::ranges::find(fields, std::string("show_at_s"), &base::Field<snapshots::Schedule>::name);
  ASSERT_NE(at, fields.end());
  const auto takes = [&](std::vector<double> times) {
    snapshots::Schedule snapshot_times;
    return at->assign(snapshot_times, times).empty() && snapshot_times.at_s == times;
  };
  EXPECT_TRUE(takes({0, 1, 1e9}));
  EXPECT_FALSE(takes({1.1e9}));
  EXPECT_FALSE(takes({-1, 1}));
  EXPECT_FALSE(takes({1, 1}));
}

TEST(Scenes, HaveAtLeastOneObject) {
  const auto fields = scene_fields();
  const auto objects =
      std::ranges::find(fields, std::string("scene.objects"), &base::Field<SceneChoice>::name);
  ASSERT_NE(objects, fields.end());
  SceneChoice scene;
  EXPECT_EQ(objects->assign(scene, std::int64_t{1}), "");
  EXPECT_EQ(scene_source(scene), "spheres:1");
  EXPECT_NE(objects->assign(scene, std::int64_t{0}), "");
}

// The times of saved pictures must count from the first task, not from the start of the machine.
TEST(KeyImages, HaveTheirTimesAfterTheSetUp) {
  renderer::Params image;
  image.width = image.height = 1;
  Rendering r;
  r.setup_s = 0.5;
  r.rgb8 = {1, 2, 3};
  r.key_images = {{{2}, "stage1", {0, 0, 0}}, {{0.25}, "early", {0, 0, 0}}};
  std::map<std::string, std::optional<double>> times;
  const auto model = machine::load_model("t805-25");
  const programs::Setup setup{model, topologies::make_line(1)};
  for (const auto& made : make_given(setup, {}, image, 1, r).extras.images)
    times[made.name.substr(made.name.rfind('-') + 1)] = made.at_s;
  EXPECT_EQ(times.at("stage1"), 1.5);
  EXPECT_EQ(times.at("early"), 0);
}

TEST(Models, EachHasItsWorkersBusyShareAndTasks) {
  observe::Use use;
  use.time_s = 10;
  const auto worker = [](const char* model, double busy_s, std::uint64_t tasks) {
    observe::CpuRow row{.name = "w", .role = to_string(Role::worker), .model = model, .tasks = {}};
    row.busy_s = busy_s;
    row.tasks = tasks;
    return row;
  };
  use.cpus = {worker("t805-25", 4, 10), worker("t805-25", 8, 20), worker("t414-20", 9, 10)};
  EXPECT_EQ(note_models(use),
            (std::vector<std::string>{
                "workers of model t805-25: 2, busy 60 % of the time, 75.0 % of the tasks, 37.5 % "
                "each",
                "workers of model t414-20: 1, busy 90 % of the time, 25.0 % of the tasks, 25.0 % "
                "each"}));
}

// In the key image of the stage, one pixel in four is lit. Key images of orders must not be
// counted.
TEST(Stages, HaveTheShareOfTheirImagesThatIsLit) {
  Rendering r;
  r.key_images = {{{1}, "stage1", {0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0}},
                  {{2}, "order1", std::vector<std::uint8_t>(12)},
                  {{3}, "stage2", {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0}}};
  std::vector<double> lit;
  for (const auto& [name, cell] : base::make_row(stage_columns(), r))
    if (name.ends_with("_lit")) lit.push_back(std::get<double>(cell));
  EXPECT_EQ(lit, (std::vector{0.25, 0.75}));
}

// If the experiment has a key of [data], every column about data must exist. It must have empty
// cells if the scene is not distributed.
TEST(DataColumns, AreThereWithAKeyAndEmptyWithoutSharing) {
  const auto row_of = [](bool is_given, bool is_shared) {
    DataFigures figures{.is_given = is_given, .use = {}};
    if (is_shared) figures.use.emplace();
    return base::make_row(data_columns(), figures);
  };
  EXPECT_TRUE(row_of(false, false).empty());
  const auto empty = row_of(true, false), shared = row_of(true, true);
  ASSERT_EQ(empty.size(), shared.size());
  for (std::size_t i = 0; i < empty.size(); ++i) {
    EXPECT_EQ(empty[i].first, shared[i].first);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(empty[i].second)) << empty[i].first;
  }
}

}  // namespace
}  // namespace ray_tracing

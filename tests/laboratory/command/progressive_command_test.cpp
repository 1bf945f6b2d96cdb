// The command `tlab render --progressive`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using Arguments = std::vector<std::string>;

Arguments render(const std::string& scene, const Arguments& more) {
  Arguments all = {"render", scene, "-o", "i.png", "--size", "40x30", "--depth", "4"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

nlohmann::json load_stats(const TemporaryFolder& folder) {
  return nlohmann::json::parse(read_file(folder.path / "s.json"));
}

TEST(ProgressiveCommand, WithoutLimitsTheFileIsTheFullImages) {
  const TemporaryFolder folder;
  for (const char* scene : {"spheres:60", "room:3"}) {
    ASSERT_EQ(tlab(folder.path, render(scene, {})).exit_code, 0);
    const auto full = read_file(folder.path / "i.png");
    for (const char* steps : {"cells", "depth"}) {
      ASSERT_EQ(tlab(folder.path, render(scene, {"--progressive", "--steps", steps, "--threads",
                                                 "2", "--key-images", steps}))
                    .exit_code,
                0);
      EXPECT_EQ(read_file(folder.path / "i.png"), full) << scene << steps;
    }
    EXPECT_EQ(read_file(folder.path / "cells/cell-1.png"), full);
    EXPECT_NE(read_file(folder.path / "cells/cell-16.png"), full);
    EXPECT_EQ(read_file(folder.path / "depth/depth-4.png"), full);
    EXPECT_NE(read_file(folder.path / "depth/depth-1.png"), full);
  }
}

TEST(ProgressiveCommand, StatsCountEachStep) {
  const TemporaryFolder folder;
  ASSERT_EQ(tlab(folder.path, render("room:2", {"--progressive", "--contrast", "0.3", "--min-cell",
                                                "2", "--max-cell", "8", "--stats", "s.json"}))
                .exit_code,
            0);
  const auto stats = load_stats(folder);
  ASSERT_EQ(stats["steps"].size(), 3u);  // one step for each of the cell sizes 8, 4 and 2 pixels
  std::uint64_t samples = 0, rays = 0;
  for (const auto& step : stats["steps"]) {
    samples += step["samples"].get<std::uint64_t>();
    rays += step["rays"]["total"].get<std::uint64_t>();
    EXPECT_EQ(step["repeated_rays"], 0);
  }
  EXPECT_EQ(stats["rays"]["primary"], samples);
  EXPECT_EQ(stats["rays"]["total"], rays);
  EXPECT_LT(samples, 40u * 30u);
  EXPECT_GT(stats["steps"][1]["divided_by_contrast"], 0);
}

TEST(ProgressiveCommand, StepsInDepthEndWithTheTreesAndRepeatRays) {
  const TemporaryFolder folder;
  const auto asked = render("room:2", {"--progressive", "--steps", "depth", "--influence", "0.05",
                                       "--depth", "1000", "--stats", "s.json"});
  ASSERT_EQ(tlab(folder.path, asked).exit_code, 2);  // refused, because --depth is given twice
  ASSERT_EQ(tlab(folder.path,
                 {"render", "room:2", "-o", "i.png", "--size", "40x30", "--depth", "1000",
                  "--influence", "0.05", "--progressive", "--steps", "depth", "--stats", "s.json"})
                .exit_code,
            0);
  const auto steps = load_stats(folder)["steps"];
  EXPECT_LT(steps.size(), 30u);
  EXPECT_EQ(steps[0]["repeated_rays"], 0);
  EXPECT_EQ(steps[1]["repeated_rays"], 40 * 30);
  EXPECT_GT(steps.back()["rays"]["total"], 0);
}

TEST(ProgressiveCommand, ThePyramidTestCanBeLeftOut) {
  const TemporaryFolder folder;
  const auto count = [&](const Arguments& more) {
    Arguments all = {"--progressive", "--contrast", "1", "--stats", "s.json"};
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(tlab(folder.path, render("room:2", all)).exit_code, 0);
    return load_stats(folder)["rays"]["primary"].get<int>();
  };
  EXPECT_LT(count({"--no-pyramid"}), count({}));
}

TEST(ProgressiveCommand, MistakesNameTheirOption) {
  const TemporaryFolder folder;
  const auto before = folder.names();
  const std::pair<Arguments, const char*> mistakes[] = {
      {{"--contrast", "1.5"}, "--contrast: found 1.5"},
      {{"--contrast", "-1"}, "--contrast: found -1"},
      {{"--min-cell", "3"}, "--min-cell: found 3, expected a power of two"},
      {{"--max-cell", "0"}, "--max-cell: found 0, expected a power of two"},
      {{"--min-cell", "32"}, "min_cell: found 32, expected at most max_cell, 16"},
      {{"--area", "30,0,20x20"}, "area: found 20 x 20 at (30, 0)"},
      {{"--preview", "flat"}, "excludes --preview"},
      {{"--steps", "sideways"}, "--steps: found sideways"},
      {{"--key-images", "/proc/no"}, "--key-images: found \"/proc/no\""}};
  for (const auto& [options, message] : mistakes) {
    Arguments all = {"--progressive"};
    all.insert(all.end(), options.begin(), options.end());
    const auto outcome = tlab(folder.path, render("room:2", all));
    EXPECT_EQ(outcome.exit_code, 2) << message;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
  const auto alone = tlab(folder.path, render("room:2", {"--contrast", "0.1"}));
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--contrast requires --progressive"), std::string::npos) << alone.err;
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace laboratory

// `tlab compare` of two pictures.
#include <gtest/gtest.h>

#include "renderer/image/picture.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using renderer::Picture;

struct CompareImages : testing::Test {
  std::string at(const std::string& name) { return (folder.path / name).string(); }
  Outcome compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return tlab(folder.path, std::move(arguments));
  }
  TemporaryFolder folder;
};

// The squares of the differences are 30^2, 6^2 and 0 elsewhere, over 3 components of 2 pixels:
// sqrt(936 / 6) = 12.49.
TEST_F(CompareImages, PngByHand) {
  renderer::save_png(at("a.png"), 2, 1, {10, 20, 30, 40, 50, 60});
  renderer::save_png(at("b.png"), 2, 1, {10, 20, 30, 40, 80, 54});
  const auto outcome = compare({"a.png", "b.png", "-o", "d.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text :
       {"a.png and b.png: 2 x 1 pixels", "RMSE                12.49 grey levels",
        "30 grey levels: green at x = 1, y = 0, 50 and 80", "1 of 2, 50.00 %", "by 8.5"})
    EXPECT_TRUE(contains(outcome.out, text)) << text << "\n" << outcome.out;
  EXPECT_EQ(renderer::load_png(at("d.png")).rgb8, (std::vector<std::uint8_t>{0, 0, 0, 0, 255, 51}));
}

TEST_F(CompareImages, ExrByHand) {
  renderer::save_exr(at("a.exr"), {1, 2, {{1, 0, 0}, {2, 4, 8}}});
  renderer::save_exr(at("b.exr"), {1, 2, {{1, 0, 0}, {2, 4, 5}}});
  const auto outcome = compare({"a.exr", "b.exr", "-o", "d.exr"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* text :
       {"RMSE                1.22474\n", "3: blue at x = 0, y = 1, 8 and 5", "multiplied by 1\n"})
    EXPECT_TRUE(contains(outcome.out, text)) << text << "\n" << outcome.out;
  EXPECT_EQ(renderer::load_exr(at("d.exr")), (Picture{1, 2, {{0, 0, 0}, {0, 0, 3}}}));
}

TEST_F(CompareImages, EqualPictures) {
  for (const std::string name : {"a.png", "a.exr"}) {
    ASSERT_EQ(tlab(folder.path, {"render", "spheres:9", "-o", name, "--size", "16x16"}).exit_code,
              0);
    const auto outcome = compare({name, name, "-o", "d.png"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "SSIM                1\n")) << outcome.out;
    EXPECT_TRUE(contains(outcome.out, "0 of 256, 0.00 %")) << outcome.out;
    EXPECT_FALSE(contains(outcome.out, "largest"));
    EXPECT_EQ(renderer::load_png(at("d.png")).rgb8, std::vector<std::uint8_t>(3 * 256, 0));
  }
}

TEST_F(CompareImages, RefusesWhatCannotBeCompared) {
  renderer::save_png(at("a.png"), 2, 1, {0, 0, 0, 0, 0, 0});
  renderer::save_png(at("c.png"), 1, 1, {0, 0, 0});
  renderer::save_exr(at("a.exr"), {1, 1, {{}}});
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"a.png", "c.png"}, "c.png: found 1 x 1 pixels, expected 2 x 1 as in a.png"},
      {{"c.png", "a.exr"}, "a.exr: found another kind of picture than c.png"},
      {{"a.png", "none.png"}, "none.png: cannot be read"},
      {{"a.png", "."}, "found a.png, ., expected two .png or .exr files"},
      {{"a.png", "a.png", "a.png"}, "expected two .png or .exr files"},
      {{"a.png", "a.png", "--columns", "time_s"}, "--columns: found pictures"},
      {{"a.png", "a.png", "-o", "d.html"}, "found d.html, expected a name that ends with .png"},
      {{"a.png", "a.png", "-o", "a.png"}, "the command reads this file"}};
  for (const auto& [arguments, expected] : cases) {
    const auto outcome = compare(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << expected;
    EXPECT_TRUE(contains(outcome.err, expected)) << outcome.err;
  }
}

}  // namespace
}  // namespace laboratory

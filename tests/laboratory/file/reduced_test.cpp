// The section [reduced] of an experiment file.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

constexpr const char* WITH_REDUCED = R"(
scene.objects = 800
image.width = 100
[sweep]
objects = [200, 800]
workers = [1, 2, 4]
[reduced]
image.width = 20
sweep.workers = [2]
)";

ExperimentFile read_reduced(const std::string& text, const std::vector<std::string>& overrides,
                            bool is_reduced) {
  return load_experiment({text, "e.toml", ""}, parse_overrides(overrides), is_reduced);
}

TEST(Reduced, ReplacesValuesOnlyIfAsked) {
  const auto whole = read_reduced(WITH_REDUCED, {}, false);
  EXPECT_EQ(whole.points.size(), 6u);
  EXPECT_EQ(whole.points[0].numbers.at("image.width"), 100);
  const auto reduced = read_reduced(WITH_REDUCED, {}, true);
  EXPECT_EQ(reduced.points.size(), 2u);
  EXPECT_EQ(reduced.points[0].numbers.at("image.width"), 20);
  EXPECT_EQ(name_of(reduced.points[1]), "objects = 800, workers = 2");
}

TEST(Reduced, ComesBeforeSet) {
  const auto file = read_reduced(WITH_REDUCED, {"image.width=30"}, true);
  EXPECT_EQ(file.points[0].numbers.at("image.width"), 30);
}

// The resolved text of a run has the values that were used, and no section [reduced].
TEST(Reduced, IsResolved) {
  for (const bool is_reduced : {false, true}) {
    const auto file = read_reduced(WITH_REDUCED, {}, is_reduced);
    EXPECT_EQ(resolve(file).find("reduced"), std::string::npos);
    EXPECT_EQ(read_reduced(resolve(file), {}, false).points.size(), file.points.size());
  }
}

TEST(Reduced, NamesAnUnknownKey) {
  const std::string text = "[reduced]\nimage.widht = 20\n";
  EXPECT_EQ(read_reduced(text, {}, false).points.size(), 1u);
  EXPECT_NE(message_of<base::BadInput>([&] { read_reduced(text, {}, true); }).find("image.widht"),
            std::string::npos);
  EXPECT_NE(
      message_of<base::BadInput>([] { read_reduced("reduced = 3\n", {}, false); }).find("section"),
      std::string::npos);
}

}  // namespace
}  // namespace laboratory

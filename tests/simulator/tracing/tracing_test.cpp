// What programs that trace rays have in common: their columns, and what is refused.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "renderer/image/animation.hpp"
#include "simulator/tracing/data.hpp"
#include "simulator/tracing/looks.hpp"
#include "simulator/tracing/rendering.hpp"
#include "tests/support/files.hpp"

namespace tracing {
namespace {

TEST(Looks, MustFitAMovingPicture) {
  const auto refusal = [](int growth, int width, int height) {
    renderer::Params image;
    image.width = width;
    image.height = height;
    return test::message_of<base::BadInput>(
        [&] { check_looks("farm", {.at_s = {}, .growth = growth}, image); });
  };
  constexpr int MOST = renderer::MAX_WEBP_SIDE;
  EXPECT_EQ(refusal(1, MOST, 1), "");
  EXPECT_EQ(refusal(1, 1, MOST), "");
  EXPECT_EQ(refusal(0, MOST + 1, MOST + 1), "");
  const std::string most = "pixels, expected at most 16383 a side";
  EXPECT_EQ(refusal(1, MOST + 1, 1), "farm.growth: found an image of 16384 x 1 " + most);
  EXPECT_EQ(refusal(1, 1, MOST + 1), "farm.growth: found an image of 1 x 16384 " + most);
  EXPECT_EQ(refusal(100, 1000, 1000), "");
  EXPECT_NE(refusal(1000, 1000, 1000).find("farm.growth: found 1000 pictures"), std::string::npos);
}

// A key image of a stage has a pixel in four that is not black; one at an order does not count.
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

// Of data: a cell in every column where a key is given, whether or not anything is shared.
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
}  // namespace tracing

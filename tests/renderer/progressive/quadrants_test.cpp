// Tests the queue of quadrants: the order of pixels, coverage of the picture, and the queue's
// length.
#include "renderer/progressive/quadrants.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::progressive {

void PrintTo(const Pixel& p, std::ostream* out) { *out << '(' << p.x << ", " << p.y << ')'; }

}  // namespace renderer::progressive

namespace renderer {

void PrintTo(const Area& a, std::ostream* out) {
  *out << '(' << a.x << ", " << a.y << ", " << a.width << " x " << a.height << ')';
}

namespace {

using progressive::own_pixel;
using progressive::Pixel;
using progressive::QuadrantQueue;

std::vector<Area> first_of(const Area& area, std::size_t count) {
  QuadrantQueue queue(area);
  std::vector<Area> blocks;
  while (blocks.size() < count) {
    const auto block = queue.next();
    if (!block) break;
    blocks.push_back(*block);
  }
  return blocks;
}

std::size_t find_peak(int width, int height) {
  QuadrantQueue queue({0, 0, width, height});
  while (queue.next()) {
  }
  return queue.peak();
}

// A picture into which the quadrants are drawn in the order of the queue.
struct Drawn {
  Area area;
  std::vector<Pixel> shown;  // by pixel: the pixel whose colour it shows
  std::vector<int> computed;

  explicit Drawn(const Area& a)
      : area(a),
        shown(static_cast<std::size_t>(a.width * a.height), {-1, -1}),
        computed(shown.size(), 0) {}

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>((y - area.y) * area.width + x - area.x);
  }
  void draw(const Area& block) {
    const Pixel own = own_pixel(block);
    ++computed[at(own.x, own.y)];
    for (int y = block.y; y < block.y + block.height; ++y)
      for (int x = block.x; x < block.x + block.width; ++x) shown[at(x, y)] = own;
  }
};

bool lies_within(const Area& inner, const Area& outer) {
  return inner.width > 0 && inner.height > 0 && inner.x >= outer.x && inner.y >= outer.y &&
         inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

// Draws the whole area. Every pixel must be computed exactly once, and no pixel may be drawn over
// after it has been computed. After the first quadrant, every pixel must show the colour of a
// computed pixel.
void expect_whole(const Area& area) {
  SCOPED_TRACE(testing::Message() << testing::PrintToString(area));
  QuadrantQueue queue(area);
  Drawn drawn(area);
  std::size_t count = 0;
  while (const auto block = queue.next()) {
    ASSERT_TRUE(lies_within(*block, area));
    if (count == 0) {
      ASSERT_EQ(*block, area);
    }
    for (int y = block->y; y < block->y + block->height; ++y)
      for (int x = block->x; x < block->x + block->width; ++x)
        ASSERT_EQ(drawn.computed[drawn.at(x, y)], 0) << "(" << x << ", " << y << ")";
    drawn.draw(*block);
    ++count;
  }
  ASSERT_EQ(count, drawn.computed.size());
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      ASSERT_EQ(drawn.computed[drawn.at(x, y)], 1);
      ASSERT_EQ(drawn.shown[drawn.at(x, y)], (Pixel{x, y}));
    }
  ASSERT_EQ(queue.length(), 0u);
  ASSERT_FALSE(queue.next());
}

TEST(Quadrants, EveryPixelOfEverySizeIsComputedOnce) {
  for (int width = 1; width <= 70; ++width)
    for (int height = 1; height <= 70; ++height)
      ASSERT_NO_FATAL_FAILURE(expect_whole({3 * width, 5 * height, width, height}));
}

TEST(Quadrants, EveryPixelOfLargerAreasIsComputedOnce) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random{seed};
    const int x = random.below(100), y = random.below(100);
    const int width = 71 + random.below(600);
    ASSERT_NO_FATAL_FAILURE(expect_whole({x, y, width, 71 + random.below(600)}));
  }
  ASSERT_NO_FATAL_FAILURE(expect_whole({0, 0, 65536, 1}));
  ASSERT_NO_FATAL_FAILURE(expect_whole({0, 0, 1, 65536}));
}

// The order in figure 6 of the paper: 1 is the upper left quadrant, 2 lower right, 3 upper right, 4
// lower left.
TEST(Quadrants, TheFirstBlocksAreInThePapersOrder) {
  const std::vector<Area> expected = {
      {0, 0, 8, 8},                              // the whole picture
      {0, 0, 4, 4}, {4, 4, 4, 4}, {4, 0, 4, 4},  // all quadrants except the lower left one
      {0, 0, 2, 2}, {2, 2, 2, 2}, {2, 0, 2, 2},  // quadrants of the upper left quadrant
      {4, 4, 2, 2}, {6, 6, 2, 2}, {6, 4, 2, 2},  // quadrants of the lower right quadrant
      {4, 0, 2, 2}, {6, 2, 2, 2}, {6, 0, 2, 2},  // quadrants of the upper right quadrant
      {0, 4, 2, 2}, {2, 6, 2, 2}, {2, 4, 2, 2},  // quadrants of the lower left quadrant
      {0, 0, 1, 1}, {1, 1, 1, 1}, {1, 0, 1, 1}, {2, 2, 1, 1}  // then single pixels
  };
  EXPECT_EQ(first_of({0, 0, 8, 8}, expected.size()), expected);
  EXPECT_EQ(own_pixel(expected[0]), (Pixel{0, 7}));
  EXPECT_EQ(own_pixel(expected[1]), (Pixel{0, 3}));
  EXPECT_EQ(own_pixel(expected[2]), (Pixel{4, 7}));
}

// If a side has an odd length, the right and upper parts are larger. The area has 5 x 3 pixels from
// (10, 20).
TEST(Quadrants, OddSidesAreDividedAsInTheListing) {
  const std::vector<Area> expected = {
      {10, 20, 5, 3},                                  //
      {10, 20, 2, 2}, {12, 22, 3, 1}, {12, 20, 3, 2},  // parts of 2 + 3 columns and 2 + 1 rows
      {10, 20, 1, 1}, {11, 21, 1, 1}, {11, 20, 1, 1},  // parts of the 2 x 2 quadrant
      {13, 22, 2, 1},  // part of the 3 x 1 quadrant; with only one row, it has only right parts
      {12, 20, 1, 1}, {13, 21, 2, 1}, {13, 20, 2, 1},  // parts of the 3 x 2 quadrant
      {11, 22, 1, 1},                                  // part of the lower left quadrant, 2 x 1
      {14, 22, 1, 1}, {14, 21, 1, 1}, {14, 20, 1, 1}};
  EXPECT_EQ(first_of({10, 20, 5, 3}, 100), expected);
}

TEST(Quadrants, TheQueueIsNoLongerThanItsBound) {
  for (int width = 1; width <= 70; ++width)
    for (int height = 1; height <= 70; ++height)
      ASSERT_LE(find_peak(width, height), static_cast<std::size_t>(std::max(1, width * height / 2)))
          << width << " x " << height;
  for (int side = 2; side <= 300; ++side)
    ASSERT_LE(find_peak(side, side), static_cast<std::size_t>(side * side / 3)) << side;
  for (int side = 2; side <= 1024; side *= 2)
    EXPECT_EQ(find_peak(side, side), static_cast<std::size_t>(side * side / 4)) << side;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::Random random{seed};
    const int width = 71 + random.below(900), height = 71 + random.below(900);
    EXPECT_LE(find_peak(width, height), static_cast<std::size_t>(width * height / 2))
        << width << " x " << height << ", seed " << seed;
  }
}

// The paper's bound on the length of the queue, N / 3, is true for squares, but not for all sizes.
TEST(Quadrants, APictureOf1920x1080NeedsMoreThanAThird) {
  const double pixels = 1920.0 * 1080;
  EXPECT_NEAR(pixels / static_cast<double>(find_peak(1920, 1080)), 2.24, 0.005);
  EXPECT_EQ(find_peak(2, 1), 1u);
}

TEST(Quadrants, TheOrderKnowsEachPixelsRank) {
  const Area area{7, 9, 13, 6};
  const auto order = progressive::make_order(area);
  EXPECT_EQ(order.quadrants, first_of(area, 1000));
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const auto rank = order.ranks[static_cast<std::size_t>(y * area.width + x)];
      EXPECT_EQ(own_pixel(order.quadrants.at(rank)), (Pixel{area.x + x, area.y + y}));
    }
}

TEST(Quadrants, AnAreaWithoutPixelsIsRefused) {
  EXPECT_THROW(QuadrantQueue({0, 0, 0, 0}), base::BadInput);
  EXPECT_THROW(QuadrantQueue({0, 0, 5, 0}), base::BadInput);
}

}  // namespace
}  // namespace renderer

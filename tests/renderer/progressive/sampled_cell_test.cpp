// Tests cells with up to 13 samples: their sample points, triangles, division and pictures.
#include "renderer/progressive/sampled_cell.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/renderer/support.hpp"

namespace renderer::progressive {
namespace {

using test::Random;
using Place = std::pair<int, int>;

constexpr int SIDES[] = {2, 4, 8, 16, 64};

// Calls `act` for cells with several sides, at each level of sampling from 1 on. The cells are not
// at the origin.
template <class Act>
void for_cells(Act act) {
  for (const int side : SIDES)
    for (int level = 1; level <= (side > 2 ? 3 : 2); ++level) {
      SCOPED_TRACE(testing::Message() << "side " << side << ", level " << level);
      act(SampledCell{7, 12, side, level});
    }
}

std::set<Place> places(const Points& points) {
  std::set<Place> all;
  for (const Point& p : points) all.insert({p.x, p.y});
  return all;
}

long cross(const Point& a, const Point& b, const Point& c) {
  return static_cast<long>(b.x - a.x) * (c.y - a.y) - static_cast<long>(b.y - a.y) * (c.x - a.x);
}

std::vector<Rgb> random_colours(Random& random, const SampledCell& cell) {
  std::vector<Rgb> colours;
  for (std::size_t i = 0; i < points_of(cell).size(); ++i) colours.push_back(random.colour());
  return colours;
}

constexpr Area EVERYWHERE{0, 0, 1000, 1000};

Painting paint(const SampledCell& cell, const std::vector<Rgb>& colours,
               const Area& image = EVERYWHERE) {
  Work work;
  return paint(cell, image, colours, work);
}

// --- samples ------------------------------------------------------------------------------------

TEST(SampledCell, LevelsAddFiveFourAndFourSamples) {
  for (const int side : {4, 8, 16, 512}) {
    const SampledCell cell{3, 5, side, 0};
    EXPECT_EQ(last_level(cell), 3);
    EXPECT_EQ(points_of_level(cell, 1).size(), 5u);
    EXPECT_EQ(points_of_level(cell, 2).size(), 4u);
    EXPECT_EQ(points_of_level(cell, 3).size(), 4u);
  }
  const SampledCell least{3, 5, 2, 0};
  EXPECT_EQ(last_level(least), 2);
  EXPECT_EQ(points_of_level(least, 1).size(), 5u);
  EXPECT_EQ(places(points_of_level(least, 2)), (std::set<Place>{{4, 5}, {3, 6}}));
}

// Samples are at multiples of a quarter of the side: at the corners and the middle, then the
// middles of the sides, then the middles of the quadrants.
TEST(SampledCell, SamplesAreOnTheLattice) {
  const SampledCell cell{40, 20, 8, 0};
  EXPECT_EQ(places(points_of_level(cell, 1)),
            (std::set<Place>{{40, 20}, {48, 20}, {40, 28}, {48, 28}, {44, 24}}));
  EXPECT_EQ(places(points_of_level(cell, 2)),
            (std::set<Place>{{44, 20}, {40, 24}, {48, 24}, {44, 28}}));
  EXPECT_EQ(places(points_of_level(cell, 3)),
            (std::set<Place>{{42, 22}, {46, 22}, {42, 26}, {46, 26}}));
}

TEST(SampledCell, NoSampleIsOutsideOrThereTwice) {
  for_cells([](const SampledCell& cell) {
    const auto points = points_of(cell);
    EXPECT_EQ(places(points).size(), points.size());
    for (const Point& p : points) {
      EXPECT_TRUE(p.x >= cell.x && p.x <= cell.x + cell.side) << p.x;
      EXPECT_TRUE(p.y >= cell.y && p.y <= cell.y + cell.side) << p.y;
    }
  });
}

TEST(SampledCell, SamplesOfALevelComeAfterThoseBefore) {
  for (const int side : SIDES) {
    const SampledCell cell{1, 2, side, side > 2 ? 3 : 2};
    Points joined;
    for (int level = 1; level <= cell.level; ++level)
      for (const Point& p : points_of_level(cell, level)) joined.push_back(p);
    EXPECT_EQ(points_of(cell), joined);
  }
}

TEST(SampledCell, TheLeastIsSampledAtEachOfItsPixels) {
  const SampledCell cell{6, 8, 2, 2};
  const auto all = places(points_of(cell));
  for (const auto& own : {Place{6, 8}, {7, 8}, {6, 9}, {7, 9}}) EXPECT_TRUE(all.contains(own));
}

TEST(SampledCell, HasNoOtherLevels) {
  const SampledCell cell{0, 0, 4, 1};
  for (const int level : {-1, 0, 4})
    EXPECT_THROW(points_of_level(cell, level), base::InvariantBroken) << level;
}

// --- triangles ----------------------------------------------------------------------------------

TEST(SampledCell, TrianglesOfALevelAreEqual) {
  for_cells([](const SampledCell& cell) {
    const auto triangles = triangles_of(cell);
    ASSERT_EQ(triangles.size(), std::size_t{2} << cell.level);
    const long doubled = 2L * cell.side * cell.side / static_cast<long>(triangles.size());
    for (const auto& [a, b, c] : triangles) EXPECT_EQ(std::abs(cross(a, b, c)), doubled);
  });
}

// Tests the points of a lattice that is 21 times finer than that of the samples. None of them lies
// on an edge of a triangle.
TEST(SampledCell, TrianglesTileTheCell) {
  for_cells([](const SampledCell& cell) {
    const auto triangles = triangles_of(cell);
    long doubled = 0;
    for (const auto& [a, b, c] : triangles) doubled += std::abs(cross(a, b, c));
    EXPECT_EQ(doubled, 2L * cell.side * cell.side);
    const auto scale = [](const Point& p) { return Point{21 * p.x, 21 * p.y}; };
    for (int y = 0; y < cell.side; ++y)
      for (int x = 0; x < cell.side; ++x) {
        const Point p{21 * (cell.x + x) + 7, 21 * (cell.y + y) + 3};
        int found = 0;
        for (const auto& triangle : triangles) {
          const Point a = scale(triangle[0]), b = scale(triangle[1]), c = scale(triangle[2]);
          const long u = cross(a, b, p), v = cross(b, c, p), w = cross(c, a, p);
          found += (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
        }
        EXPECT_EQ(found, 1) << x << " " << y;
      }
  });
}

// A cell of side 2 is an exception at level 2: two corners of its triangles are samples of
// neighbouring cells. None of its own pixels needs them.
TEST(SampledCell, TrianglesHaveSamplesAtTheirCorners) {
  for_cells([](const SampledCell& cell) {
    if (cell.side == 2 && cell.level == 2) return;
    const auto sampled = places(points_of(cell));
    for (const auto& triangle : triangles_of(cell))
      for (const Point& p : triangle) EXPECT_TRUE(sampled.contains({p.x, p.y}));
  });
}

// --- the cells of a divided cell (daughters) ----------------------------------------------------

TEST(SampledCell, DaughtersBeginWithTheirFirstLevel) {
  for (const int side : {4, 8, 16, 64}) {
    const SampledCell mother{5, 9, side, 3};
    const auto known = places(points_of(mother));
    std::set<Place> used;
    for (const auto& daughter : divide(mother)) {
      EXPECT_EQ(daughter.side, side / 2);
      EXPECT_EQ(daughter.level, 1);
      const auto needed = places(points_of(daughter));
      EXPECT_EQ(needed.size(), 5u);
      used.insert(needed.begin(), needed.end());
    }
    EXPECT_EQ(used, known);
  }
}

TEST(SampledCell, DaughtersShareOutThePixels) {
  for (const int side : {4, 8, 16}) {
    const SampledCell mother{5, 9, side, 3};
    const auto daughters = divide(mother);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        int owners = 0;
        for (const auto& daughter : daughters) owners += owns(daughter, {x, y});
        EXPECT_EQ(owners, int(owns(mother, {x, y}))) << x << " " << y;
      }
    EXPECT_EQ(Place(daughters[1].x, daughters[1].y), Place(5 + side / 2, 9));
    EXPECT_EQ(Place(daughters[2].x, daughters[2].y), Place(5, 9 + side / 2));
  }
}

// --- pictures -----------------------------------------------------------------------------------

std::uint8_t byte_at(const Painting& painting, int x, int y, int component) {
  const auto& area = painting.area;
  return painting.rgb8.at(
      static_cast<std::size_t>(3 * ((y - area.y) * area.width + x - area.x) + component));
}

void expect_level(std::uint8_t byte, double colour, double within) {
  EXPECT_NEAR(byte, 255 * std::clamp(colour, 0.0, 1.0), within);
}

void expect_colour(const Painting& painting, int x, int y, const Rgb& colour, double within) {
  SCOPED_TRACE(testing::Message() << "pixel " << x << " " << y);
  expect_level(byte_at(painting, x, y, 0), colour.r, within);
  expect_level(byte_at(painting, x, y, 1), colour.g, within);
  expect_level(byte_at(painting, x, y, 2), colour.b, within);
}

constexpr double ROUNDED = 0.5 + 1e-6;

TEST(SampledCell, PaintsARampAsItIs) {
  for_cells([](const SampledCell& cell) {
    const auto ramp = [&](const Point& p) {
      const double u = double(p.x - cell.x) / cell.side, v = double(p.y - cell.y) / cell.side;
      return Rgb{0.1 + 0.3 * u + 0.5 * v, 0.9 - 0.6 * u - 0.2 * v, 0.4 + 0.5 * u - 0.4 * v};
    };
    std::vector<Rgb> colours;
    for (const Point& p : points_of(cell)) colours.push_back(ramp(p));
    const auto painting = paint(cell, colours);
    EXPECT_EQ(painting.area, (Area{cell.x, cell.y, cell.side, cell.side}));
    for (int y = cell.y; y < cell.y + cell.side; ++y)
      for (int x = cell.x; x < cell.x + cell.side; ++x)
        expect_colour(painting, x, y, ramp({x, y}), ROUNDED);
  });
}

TEST(SampledCell, PaintsSamplesAsTheyAre) {
  Random random{31};
  for_cells([&](const SampledCell& cell) {
    const auto colours = random_colours(random, cell);
    const auto painting = paint(cell, colours);
    const auto points = points_of(cell);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!owns(cell, points[i])) continue;
      const auto expected = make_rgb8(colours[i]);
      for (int component = 0; component < 3; ++component)
        EXPECT_EQ(byte_at(painting, points[i].x, points[i].y, component),
                  expected[static_cast<std::size_t>(component)]);
    }
  });
}

// Interpolates in every triangle that contains a pixel. A pixel on an edge is in two or more
// triangles. All results must equal the picture.
TEST(SampledCell, PaintsWhatItsTrianglesSay) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const int side = 2 << random.below(5);
    SampledCell cell{random.below(50), random.below(50), side, 1 + random.below(side > 2 ? 3 : 1)};
    const auto colours = random_colours(random, cell);
    std::map<Place, Rgb> colour_of;
    const auto points = points_of(cell);
    for (std::size_t i = 0; i < points.size(); ++i)
      colour_of[{points[i].x, points[i].y}] = colours[i];
    const auto painting = paint(cell, colours);
    for (int y = cell.y; y < cell.y + side; ++y)
      for (int x = cell.x; x < cell.x + side; ++x) {
        int found = 0;
        for (const auto& [a, b, c] : triangles_of(cell)) {
          const auto whole = double(cross(a, b, c));
          const double at_a = double(cross(b, c, {x, y})) / whole;
          const double at_b = double(cross(c, a, {x, y})) / whole;
          const double at_c = double(cross(a, b, {x, y})) / whole;
          if (at_a < 0 || at_b < 0 || at_c < 0) continue;
          ++found;
          const Rgb expected = at_a * colour_of.at({a.x, a.y}) + at_b * colour_of.at({b.x, b.y}) +
                               at_c * colour_of.at({c.x, c.y});
          expect_colour(painting, x, y, expected, ROUNDED);
        }
        EXPECT_GT(found, 0);
      }
  }
}

// Parts beyond the border of the image are omitted, without any effect on the other pixels.
TEST(SampledCell, PaintsWithinTheImageAlone) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Area image{5, 3, 9 + random.below(10), 7 + random.below(10)};
    const int side = 2 << random.below(4);
    const SampledCell cell{random.below(30), random.below(30), side,
                           1 + random.below(side > 2 ? 3 : 2)};
    const auto colours = random_colours(random, cell);
    const auto whole = paint(cell, colours);
    const auto cut = paint(cell, colours, image);
    std::size_t pixels = 0;
    for (int y = image.y; y < image.y + image.height; ++y)
      for (int x = image.x; x < image.x + image.width; ++x) {
        if (!owns(cell, {x, y})) continue;
        ++pixels;
        for (int component = 0; component < 3; ++component)
          ASSERT_EQ(byte_at(cut, x, y, component), byte_at(whole, x, y, component));
      }
    EXPECT_EQ(cut.rgb8.size(), 3 * pixels);
    EXPECT_EQ(static_cast<std::size_t>(cut.area.width) * static_cast<std::size_t>(cut.area.height),
              pixels);
  }
}

TEST(SampledCell, CountsPixelsAndThoseInterpolated) {
  for_cells([](const SampledCell& cell) {
    Random random{5};
    const Area image{cell.x, cell.y, cell.side, cell.side / 2};
    std::uint64_t sampled = 0;
    for (const Point& p : points_of(cell)) sampled += owns(cell, p) && p.y < cell.y + cell.side / 2;
    Work work;
    paint(cell, image, random_colours(random, cell), work);
    const auto pixels = static_cast<std::uint64_t>(cell.side * cell.side / 2);
    EXPECT_EQ(work[Op::pixel_drawn], pixels);
    EXPECT_EQ(work[Op::pixel_interpolated], pixels - sampled);
  });
}

}  // namespace
}  // namespace renderer::progressive

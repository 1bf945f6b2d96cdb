// Compares pictures with references whose errors are known.
#include "renderer/radiosity/show/compare_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::test {
namespace {

constexpr Display LINEAR{.exposure = 1, .gamma = 1};

// Rows 0 and 2 are twice as bright as the reference. Row 1 equals the reference.
TEST(ComparePictures, OfALineAreThoseOfItsRowOnly) {
  const Rgb grey{0.4, 0.4, 0.4}, bright{0.8, 0.8, 0.8};
  const Picture reference{2, 3, std::vector(6, grey)};
  const Picture picture{2, 3, {bright, bright, grey, grey, bright, bright}};
  for (const int line : {0, 1, 2}) {
    SCOPED_TRACE(line);
    const auto found = compare_pictures(picture, reference, LINEAR,
                                        {.left_out = std::vector<bool>(6), .line = line});
    const double expected = line == 1 ? 0 : 1;
    EXPECT_DOUBLE_EQ(found.image, std::sqrt(4.0 / 6));
    EXPECT_DOUBLE_EQ(found.line, expected);
    EXPECT_DOUBLE_EQ(found.line_peak, expected);
    EXPECT_DOUBLE_EQ(found.line_linear, expected);
    EXPECT_DOUBLE_EQ(found.line_peak_linear, expected);
    EXPECT_EQ(found.peak_shift, 0);
  }
}

// The reference's peak is in pixel 1, that of the picture in pixel 3. Without pixel 3, or to the
// left of it, both are in pixel 1.
TEST(ComparePictures, PeaksAreThoseOfTheComparedPixels) {
  const auto grey = [](double value) { return Rgb{value, value, value}; };
  const Picture reference{4, 1, {grey(0.2), grey(0.5), grey(0.3), grey(0.1)}};
  const Picture picture{4, 1, {grey(0.2), grey(0.4), grey(0.3), grey(1)}};
  const auto compare = [&](std::vector<bool> left_out, double peak_to) {
    return compare_pictures(picture, reference, LINEAR,
                            {.left_out = std::move(left_out), .peak_to = peak_to});
  };
  const auto all = compare({false, false, false, false}, 1);
  EXPECT_EQ(all.peak_shift, 2);
  EXPECT_DOUBLE_EQ(all.line_peak_linear, 1);
  for (const auto& part :
       {compare({false, false, false, true}, 1), compare({false, false, false, false}, 0.75)}) {
    EXPECT_EQ(part.peak_shift, 0);
    EXPECT_DOUBLE_EQ(part.line_peak_linear, 0.2);
  }
}

}  // namespace
}  // namespace radiosity::test

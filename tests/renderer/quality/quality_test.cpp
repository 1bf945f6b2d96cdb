// Tests quality measures of pictures: cases calculated by hand, and properties of random pictures.
#include "renderer/quality/quality.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// A grey picture with the given levels, row by row.
Bitmap make_grey(int width, int height, const std::vector<int>& levels) {
  Bitmap picture{width, height, {}};
  for (const int level : levels) picture.rgb8.insert(picture.rgb8.end(), 3, std::uint8_t(level));
  return picture;
}

// A grey picture with waves of levels from 60 to 195 and a little noise.
Bitmap make_random_picture(Random& random) {
  const int width = 1 + random.below(40), height = 1 + random.below(40);
  const double fast = random.range(0.1, 1), slow = random.range(0.02, 0.1);
  Bitmap picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.rgb8.push_back(
            std::uint8_t(std::lround(127 + 30 * std::sin(fast * x + c) +
                                     30 * std::cos(slow * y * (x + 1)) + random.range(-7, 7))));
  return picture;
}

Bitmap add_noise(const Bitmap& picture, double most, std::uint64_t seed) {
  Random random{seed};
  Bitmap noisy = picture;
  for (auto& level : noisy.rgb8)
    level = std::uint8_t(std::lround(level + random.range(-most, most)));
  return noisy;
}

// Evaluates the definition of SSIM window by window, without sliding sums.
double eval_plain_ssim(const Bitmap& a, const Bitmap& b) {
  const int columns = std::min(8, a.width), rows = std::min(8, a.height);
  const auto luminance = [](const Bitmap& p, int x, int y) {
    const std::uint8_t* rgb = &p.rgb8[std::size_t(3 * (y * p.width + x))];
    return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  };
  double sum = 0;
  int count = 0;
  for (int top = 0; top + rows <= a.height; ++top)
    for (int left = 0; left + columns <= a.width; ++left, ++count) {
      const auto mean = [&](const auto& value) {
        double total = 0;
        for (int y = top; y < top + rows; ++y)
          for (int x = left; x < left + columns; ++x)
            total += value(luminance(a, x, y), luminance(b, x, y));
        return total / (columns * rows);
      };
      const double ma = mean([](double p, double) { return p; }),
                   mb = mean([](double, double q) { return q; }),
                   va = mean([&](double p, double) { return (p - ma) * (p - ma); }),
                   vb = mean([&](double, double q) { return (q - mb) * (q - mb); }),
                   cov = mean([&](double p, double q) { return (p - ma) * (q - mb); });
      sum += (2 * ma * mb + 6.5025) * (2 * cov + 58.5225) /
             ((ma * ma + mb * mb + 6.5025) * (va + vb + 58.5225));
    }
  return sum / count;
}

TEST(Rmse, ByHand) {
  EXPECT_EQ(rmse({1, 1, {10, 20, 30}}, {1, 1, {10, 20, 30}}), 0);
  EXPECT_EQ(rmse(make_grey(2, 1, {0, 0}), make_grey(2, 1, {255, 255})), 255);
  EXPECT_EQ(rmse({1, 1, {0, 0, 0}}, {1, 1, {1, 5, 1}}), 3);  // sqrt((1 + 25 + 1) / 3)
}

TEST(Ssim, ByHand) {
  EXPECT_DOUBLE_EQ(ssim(make_grey(1, 1, {0}), make_grey(1, 1, {255})), 6.5025 / (65025 + 6.5025));
  // Both pictures have the mean 127.5 and the variance 16256.25. Their covariance is -16256.25.
  EXPECT_DOUBLE_EQ(ssim(make_grey(2, 1, {0, 255}), make_grey(2, 1, {255, 0})),
                   (-32512.5 + 58.5225) / (32512.5 + 58.5225));
  // In pictures of one pixel, only the luminance of red, green and blue matters.
  const auto mean_only = [](double p, double q) {
    return (2 * p * q + 6.5025) / (p * p + q * q + 6.5025);
  };
  EXPECT_DOUBLE_EQ(ssim({1, 1, {100, 0, 0}}, {1, 1, {0, 100, 0}}), mean_only(29.9, 58.7));
  EXPECT_DOUBLE_EQ(ssim({1, 1, {0, 0, 100}}, {1, 1, {0, 100, 0}}), mean_only(11.4, 58.7));
}

TEST(Ssim, MeansOverAllWindows) {
  // In pictures of 9 x 1 pixels, windows of 8 x 1 begin at the first and the second pixel. Only the
  // second window differs.
  const auto a = make_grey(9, 1, {0, 0, 0, 0, 0, 0, 0, 0, 0}),
             b = make_grey(9, 1, {0, 0, 0, 0, 0, 0, 0, 0, 80});
  const double mean = 10, variance = 80.0 * 80 / 8 - 100;
  EXPECT_DOUBLE_EQ(ssim(a, b),
                   (1 + 6.5025 / (mean * mean + 6.5025) * 58.5225 / (variance + 58.5225)) / 2);
}

TEST(Ssim, PropertiesOnRandomPictures) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Bitmap a = make_random_picture(random);
    EXPECT_EQ(ssim(a, a), 1);
    EXPECT_EQ(rmse(a, a), 0);
    double last_ssim = 1, last_rmse = 0;
    for (const double noise : {6, 15, 30, 50}) {
      const Bitmap b = add_noise(a, noise, seed);
      const double found = ssim(a, b), error = rmse(a, b);
      EXPECT_EQ(found, ssim(b, a));
      EXPECT_EQ(error, rmse(b, a));
      EXPECT_NEAR(found, eval_plain_ssim(a, b), 1e-11);
      EXPECT_GT(error, last_rmse);
      if (a.width >= 4 && a.height >= 4) {
        EXPECT_LT(found, last_ssim);
      }
      last_ssim = found;
      last_rmse = error;
    }
    // Noise that is uniform from -50 to 50 has a standard deviation of 50 / sqrt(3) = 28.9.
    if (a.rgb8.size() > 1000) {
      EXPECT_NEAR(last_rmse, 28.9, 2.5);
    }
  }
}

TEST(BorderEnergy, ByHand) {
  // The second differences at pixels 1 to 4 are 0, 10, -10, 0. Those at pixels 1 and 4 lie inside a
  // cell; those at pixels 2 and 3 cross the border.
  EXPECT_DOUBLE_EQ(border_energy(make_grey(6, 1, {0, 0, 0, 10, 10, 10}), 3), 100.5 / 0.5);
  EXPECT_DOUBLE_EQ(border_energy(make_grey(1, 6, {0, 0, 0, 10, 10, 10}), 3), 100.5 / 0.5);
  // The picture has a bend at the border between cells: the second differences are 0, 0, 4, 0.
  EXPECT_DOUBLE_EQ(border_energy(make_grey(6, 1, {0, 0, 0, 0, 4, 8}), 3), 8.5 / 0.5);
  // The picture has a step inside a cell: the second differences at pixels 4 and 5 are -7 and 7.
  // Three second differences lie inside cells.
  EXPECT_DOUBLE_EQ(border_energy(make_grey(9, 1, {9, 9, 9, 9, 2, 2, 2, 2, 2}), 3),
                   (49 / 4.0 + 0.5) / (49 / 3.0 + 0.5));
}

TEST(BorderEnergy, IsOneWithoutBordersToSee) {
  EXPECT_EQ(border_energy(make_grey(6, 6, std::vector<int>(36, 77)), 3), 1);
  EXPECT_EQ(border_energy(make_grey(6, 1, {0, 9, 200, 3, 5, 0}), 8), 1);
  EXPECT_EQ(border_energy(make_grey(1, 1, {5}), 3), 1);
  EXPECT_EQ(border_energy(make_grey(6, 1, {0, 10, 20, 30, 40, 50}), 3), 1);
}

TEST(BorderEnergy, FindsTheGridOfRandomMosaics) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const int side = 3 + random.below(6), cells = 3 + random.below(4), length = side * cells;
    std::vector<int> of_cells, levels, turned;
    for (int i = 0; i < cells * cells; ++i) of_cells.push_back(random.below(256));
    const auto level = [&](int x, int y) {
      return of_cells[std::size_t(y / side * cells + x / side)];
    };
    for (int y = 0; y < length; ++y)
      for (int x = 0; x < length; ++x) {
        levels.push_back(level(x, y));
        turned.push_back(level(y, x));
      }
    const double found = border_energy(make_grey(length, length, levels), side);
    EXPECT_GT(found, 1000);
    EXPECT_DOUBLE_EQ(border_energy(make_grey(length, length, turned), side), found);
    EXPECT_LT(border_energy(make_grey(length, length, levels), side + 1), found / 100);
  }
}

TEST(Quality, NamesWhatIsWrong) {
  const Bitmap a = make_grey(2, 1, {0, 0}), b = make_grey(1, 2, {0, 0});
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { rmse(a, b); }),
            "rmse: found pictures of 2 x 1 and 1 x 2 pixels, expected equal sizes");
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { ssim(a, b); }),
            "ssim: found pictures of 2 x 1 and 1 x 2 pixels, expected equal sizes");
  for (const Bitmap& other : {make_grey(2, 2, {0, 0, 0, 0}), make_grey(1, 1, {0})})
    EXPECT_NE(::test::message_of<base::BadInput>([&] { ssim(a, other); }), "");
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { ssim({}, {}); }),
            "ssim: found an image without pixels, expected 1 or more");
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { border_energy(a, 2); }),
            "border_energy: found cells of 2 pixels, expected 3 or more");
}

TEST(Quality, OfSamples) {
  Samples samples(1, 1);
  samples.add(0, {1, 0.5, 0});
  EXPECT_EQ(make_bitmap(samples), (Bitmap{1, 1, {255, 128, 0}}));
}

}  // namespace
}  // namespace renderer::test

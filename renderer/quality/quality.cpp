#include "renderer/quality/quality.hpp"

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

// Luminances are integers, so that sums are exact and equal windows have equal moments.
using Numbers = std::vector<std::int64_t>;

constexpr std::int64_t LEVEL = 1000;  // units of luminance per grey level

// Luminance of each pixel, from 0 to 255 * LEVEL.
Numbers make_luminance(const Bitmap& picture) {
  Numbers all;
  all.reserve(picture.rgb8.size() / 3);
  for (std::size_t i = 0; i < picture.rgb8.size(); i += 3)
    all.push_back(299 * picture.rgb8[i] + 587 * picture.rgb8[i + 1] + 114 * picture.rgb8[i + 2]);
  return all;
}

template <class Image>
void check_sizes(const Image& a, const Image& b, const char* who) {
  require(
      a.width == b.width && a.height == b.height, who,
      fmt::format("pictures of {} x {} and {} x {} pixels", a.width, a.height, b.width, b.height),
      "equal sizes");
}

void check_pair(const Bitmap& a, const Bitmap& b, const char* who) {
  check(a, who);
  check(b, who);
  check_sizes(a, b, who);
}

// All positions of a window in a picture.
struct Windows {
  static constexpr int SIDE = 8;
  // Width of the picture; width and height of a window; number of positions from top to bottom.
  std::size_t width, columns, rows, down;

  Windows(int picture_width, int picture_height)
      : width(static_cast<std::size_t>(picture_width)),
        columns(static_cast<std::size_t>(std::min(SIDE, picture_width))),
        rows(static_cast<std::size_t>(std::min(SIDE, picture_height))),
        down(static_cast<std::size_t>(picture_height) - rows + 1) {}

  // The sum of x[i] * y[i] over the pixels i of each window.
  Numbers sum(const Numbers& x, const Numbers& y) const {
    Numbers strips(width), sums;  // strips: by column, the sum over the rows of a window
    const auto product = [&](std::size_t row, std::size_t column) {
      return x[row * width + column] * y[row * width + column];
    };
    for (std::size_t row = 0; row < rows - 1; ++row)
      for (std::size_t i = 0; i < width; ++i) strips[i] += product(row, i);
    for (std::size_t row = 0; row < down; ++row) {
      for (std::size_t i = 0; i < width; ++i) strips[i] += product(row + rows - 1, i);
      std::int64_t window = 0;
      for (std::size_t i = 0; i < width; ++i) {
        window += strips[i];
        if (i + 1 >= columns) {
          sums.push_back(window);
          window -= strips[i + 1 - columns];
        }
      }
      for (std::size_t i = 0; i < width; ++i) strips[i] -= product(row, i);
    }
    return sums;
  }
};

}  // namespace

double rmse(const Bitmap& a, const Bitmap& b) {
  check_pair(a, b, "rmse");
  std::int64_t squares = 0;
  for (std::size_t i = 0; i < a.rgb8.size(); ++i) {
    const int difference = a.rgb8[i] - b.rgb8[i];
    squares += difference * difference;
  }
  return std::sqrt(static_cast<double>(squares) / static_cast<double>(a.rgb8.size()));
}

double rms_difference(const Samples& a, const Samples& b) {
  require(a.width == b.width && a.height == b.height && !a.sums.empty(), "rms_difference",
          fmt::format("images of {} x {} and {} x {} pixels", a.width, a.height, b.width, b.height),
          "equal sizes of at least one pixel");
  double squares = 0;
  for (std::size_t i = 0; i < a.sums.size(); ++i) {
    const Rgb p = to_rgb(a.sums[i]), q = to_rgb(b.sums[i]);
    for (const auto component : {&Rgb::r, &Rgb::g, &Rgb::b}) {
      const double difference =
          std::clamp(p.*component, 0.0, 1.0) - std::clamp(q.*component, 0.0, 1.0);
      squares += difference * difference;
    }
  }
  return std::sqrt(squares / (3 * static_cast<double>(a.sums.size())));
}

PictureDifference find_difference(const Picture& a, const Picture& b) {
  constexpr const char* WHO = "find_difference";
  check_sizes(a, b, WHO);
  require(!a.pixels.empty(), WHO, "a picture without pixels", "1 or more");
  constexpr std::pair<double Rgb::*, const char*> COMPONENTS[] = {
      {&Rgb::r, "red"}, {&Rgb::g, "green"}, {&Rgb::b, "blue"}};
  PictureDifference found;
  double squares = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgb &p = a.pixels[i], &q = b.pixels[i];
    bool is_equal = true;
    for (const auto& [component, name] : COMPONENTS) {
      const double difference = std::abs(p.*component - q.*component);
      squares += difference * difference;
      is_equal = is_equal && difference == 0;
      if (difference <= found.largest) continue;
      const auto at = static_cast<int>(i);
      found.largest = difference, found.component = name;
      found.x = at % a.width, found.y = at / a.width;
      found.a = p.*component, found.b = q.*component;
    }
    found.pixels += !is_equal;
  }
  found.rms = std::sqrt(squares / (3 * static_cast<double>(a.pixels.size())));
  return found;
}

double ssim(const Bitmap& a, const Bitmap& b) {
  check_pair(a, b, "ssim");
  constexpr double C1 = 0.01 * 255 * 0.01 * 255, C2 = 0.03 * 255 * 0.03 * 255;
  const Windows windows(a.width, a.height);
  const Numbers x = make_luminance(a), y = make_luminance(b), ones(x.size(), 1);
  const Numbers sx = windows.sum(x, ones), sy = windows.sum(y, ones), sxx = windows.sum(x, x),
                syy = windows.sum(y, y), sxy = windows.sum(x, y);
  const auto n = static_cast<std::int64_t>(windows.columns * windows.rows);
  const double unit = static_cast<double>(n) * LEVEL, square = unit * unit;
  // The covariance of two quantities p and q: the mean of p * q minus the product of the means.
  const auto covariance = [&](std::int64_t pq, std::int64_t p, std::int64_t q) {
    return static_cast<double>(n * pq - p * q) / square;
  };
  double sum = 0;
  for (std::size_t i = 0; i < sx.size(); ++i) {
    const double mx = static_cast<double>(sx[i]) / unit, my = static_cast<double>(sy[i]) / unit;
    const double vx = covariance(sxx[i], sx[i], sx[i]), vy = covariance(syy[i], sy[i], sy[i]);
    sum += (2 * mx * my + C1) * (2 * covariance(sxy[i], sx[i], sy[i]) + C2) /
           ((mx * mx + my * my + C1) * (vx + vy + C2));
  }
  return sum / static_cast<double>(sx.size());
}

double border_energy(const Bitmap& picture, int side) {
  constexpr const char* WHO = "border_energy";
  // Variance of the second difference a - 2 b + c due to rounding. Rounding gives each of the
  // values a, b and c a variance of 1/12.
  constexpr double ROUNDING = (1 + 4 + 1) / 12.0;
  check(picture, WHO);
  require(side >= MIN_BORDERED_CELL, WHO, fmt::format("cells of {} pixels", side),
          fmt::format("{} or more", MIN_BORDERED_CELL));
  const Numbers light = make_luminance(picture);
  struct Mean {
    double sum = 0, count = 0;
    double eval() const { return count > 0 ? sum / count : 0; }
  } border, inside;
  // Adds the second difference at the position `at` in a row or column of `length` pixels. `pixel`
  // is the index of the pixel there; `step` is the distance between indices of neighbours.
  const auto add = [&](std::size_t pixel, int at, int length, std::size_t step) {
    if (at == 0 || at == length - 1) return;
    const double second =
        static_cast<double>(light[pixel - step] - 2 * light[pixel] + light[pixel + step]) / LEVEL;
    Mean& mean = (at - 1) / side == (at + 1) / side ? inside : border;
    mean.sum += second * second;
    mean.count += 1;
  };
  const auto width = static_cast<std::size_t>(picture.width);
  std::size_t pixel = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++pixel) {
      add(pixel, x, picture.width, 1);
      add(pixel, y, picture.height, width);
    }
  if (border.count == 0 || inside.count == 0) return 1;
  return (border.eval() + ROUNDING) / (inside.eval() + ROUNDING);
}

}  // namespace renderer

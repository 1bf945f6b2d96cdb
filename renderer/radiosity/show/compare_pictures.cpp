#include "renderer/radiosity/show/compare_pictures.hpp"

#include <cmath>

namespace radiosity {

namespace {

// Sums of the squares of the difference and of the reference.
struct Squares {
  double difference = 0, reference = 0;
  void add(double found, double expected) {
    difference += (found - expected) * (found - expected);
    reference += expected * expected;
  }
  double eval() const { return reference > 0 ? std::sqrt(difference / reference) : 0; }
};

struct LineError {
  double error = 0, peak = 0;
  int shift = 0;
};

// Compares the picture with the reference along a row. value(pixel, false) is the value of a pixel
// in the picture, value(pixel, true) that in the reference.
template <class Value>
LineError compare_lines(int width, const Compared& where, const Value& value) {
  Squares squares;
  double peak = 0, reference_peak = 0;
  int at = 0, reference_at = 0;
  for (int x = 0; x < width; ++x) {
    const auto pixel = static_cast<std::size_t>(where.line) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x);
    if (where.left_out[pixel]) continue;
    const double found = value(pixel, false), expected = value(pixel, true);
    squares.add(found, expected);
    if ((x + 0.5) / width < where.peak_from || (x + 0.5) / width > where.peak_to) continue;
    if (found > peak) peak = found, at = x;
    if (expected > reference_peak) reference_peak = expected, reference_at = x;
  }
  const double off = reference_peak > 0 ? std::abs(peak - reference_peak) / reference_peak : 0;
  return {squares.eval(), off, at - reference_at};
}

}  // namespace

PictureError compare_pictures(const Picture& picture, const Picture& reference,
                              const Display& display, const Compared& where) {
  Squares squares;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (where.left_out[i]) continue;
    const Rgb &p = picture.pixels[i], &q = reference.pixels[i];
    squares.add(p.r, q.r), squares.add(p.g, q.g), squares.add(p.b, q.b);
  }
  const auto shown = make_rgb8(picture, display), expected = make_rgb8(reference, display);
  const auto linear =
      compare_lines(picture.width, where, [&](std::size_t pixel, bool of_reference) {
        return (of_reference ? reference : picture).pixels[pixel].r;
      });
  const auto displayed =
      compare_lines(picture.width, where, [&](std::size_t pixel, bool of_reference) {
        return double((of_reference ? expected : shown)[3 * pixel]);
      });
  return {squares.eval(), displayed.error, displayed.peak, linear.error, linear.peak, linear.shift};
}

Picture make_displayed(const Picture& picture, const Display& display) {
  const auto bytes = make_rgb8(picture, display);
  Picture shown{picture.width, picture.height, {}};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    shown.pixels.push_back(
        {bytes[3 * i] / 255.0, bytes[3 * i + 1] / 255.0, bytes[3 * i + 2] / 255.0});
  return shown;
}

}  // namespace radiosity

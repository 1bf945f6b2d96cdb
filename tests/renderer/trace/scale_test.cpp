// Tolerances follow the ray, not the largest object of the scene.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

// Objects of some `size` on a ground, seen from above: a ball, a mirror box, glass.
std::string describe_objects(double size) {
  std::string text = fmt::format(
      "v from 0 {0} {1} at 0 {2} 0 up 0 1 0 angle 45\nb 0.5 0.7 1\nl {3} {4} {5}\n"
      "f 1 0 0 0.8 0.2 20 0 1\ns 0 {2} 0 {2}\nf 1 1 1 0.1 0.1 5 0.8 1.5\ns {6} {2} 0 {2}\n"
      "f 0 1 0 0.5 0.5 9 0 1\n",
      9 * size, 3 * size, size, 50 * size, 100 * size, 30 * size, 2.2 * size);
  const Vec lo{-3.5 * size, 0, -size}, hi{-1.5 * size, 1.5 * size, size};
  const auto face = [&](const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
    text += "p 4";
    for (const Vec& p : {a, b, c, d}) text += fmt::format(" {} {} {}", p.x, p.y, p.z);
    text += "\n";
  };
  face({lo.x, hi.y, lo.z}, {lo.x, hi.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, hi.y, lo.z});
  face({lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z});
  face({hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, hi.y, hi.z}, {hi.x, lo.y, hi.z});
  return text;
}

std::string describe_square(double extent) {
  return fmt::format("f 0.8 0.8 0.8 1 0 0 0 1\np 4 {0} 0 {0} {0} 0 {1} {1} 0 {1} {1} 0 {0}\n",
                     -extent, extent);
}

std::string describe_triangles(double extent) {
  return fmt::format(
      "f 0.8 0.8 0.8 1 0 0 0 1\np 3 {0} 0 {0} {0} 0 {1} {1} 0 {1}\np 3 {0} 0 {0} {1} 0 {1} {1} 0 "
      "{0}\n",
      -extent, extent);
}

std::string describe_ball(double extent) {
  return fmt::format("f 0.8 0.8 0.8 1 0 0 0 1\ns 0 {0} 0 {1}\n", -extent, extent);
}

Samples render_with(const std::string& objects, const std::string& ground) {
  return render(parse(objects + ground), make_params(48, 48, 6)).samples;
}

// The share of the pixels that differ by more than 1 %.
double compare(const Samples& a, const Samples& b) {
  int differ = 0;
  for (std::size_t i = 0; i < a.sums.size(); ++i)
    differ += std::abs(static_cast<double>(a.sums[i].r - b.sums[i].r)) > 0.01 * 0x1p32 ||
              std::abs(static_cast<double>(a.sums[i].g - b.sums[i].g)) > 0.01 * 0x1p32;
  return differ / static_cast<double>(a.sums.size());
}

TEST(Scale, AHugeGroundHidesNothing) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    const std::string objects = describe_objects(size);
    for (const auto describe : {&describe_square, &describe_triangles, &describe_ball}) {
      const Samples expected = render_with(objects, describe(1e5 * size));
      for (const double extent : {1e7, 1e9, 1e10, 1e12}) {
        // A ball's surface is rounded to 1e-16 of its radius. The plane y = 0 is exact.
        if (describe == &describe_ball && extent > 1e10) continue;
        SCOPED_TRACE(fmt::format("size {}, ground {} times", size, extent));
        EXPECT_LT(compare(render_with(objects, describe(extent * size)), expected), 0.01);
      }
    }
  }
}

TEST(Scale, ADistantObjectHidesNothing) {
  const std::string objects = describe_objects(1) + describe_square(100);
  const Samples expected = render_with(objects, "");
  for (const double distance : {1e8, 1e11, 1e14})
    EXPECT_EQ(render_with(objects, fmt::format("s {0} {0} 0 1\n", distance)), expected);
}

}  // namespace
}  // namespace renderer::test

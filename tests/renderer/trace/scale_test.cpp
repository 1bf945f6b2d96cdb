// Tests that numerical tolerances depend on the ray, not on the largest object of the scene.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

// The axes of a scene. The ground is its plane y = 0.
struct Frame {
  Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;

  std::string operator()(const Vec& p) const {
    const Vec at = origin + p.x * x + p.y * y + p.z * z;
    return fmt::format(" {} {} {}", at.x, at.y, at.z);
  }
};

Frame make_frame(std::uint64_t seed, double distance) {
  Random random{seed};
  const Vec n = random.direction();
  const auto [u, v] = make_plane(n);
  return {u, n, v, distance * random.direction()};
}

// Objects of a given `size` on a ground, seen from above: a ball, a box of mirrors, and glass.
std::string describe_objects(double size, const Frame& frame = {}) {
  const auto at = [&](double x, double y, double z) { return frame(size * Vec{x, y, z}); };
  std::string text =
      fmt::format("v from{} at{} up {} {} {} angle 45\nb 0.5 0.7 1\nl{}\n", at(0, 9, 3),
                  at(0, 1, 0), frame.y.x, frame.y.y, frame.y.z, at(50, 100, 30));
  text += fmt::format(
      "f 1 0 0 0.8 0.2 20 0 1\ns{} {}\nf 1 1 1 0.1 0.1 5 0.8 1.5\ns{} {}\nf 0 1 0 0.5 0.5 9 0 1\n",
      at(0, 1, 0), size, at(2.2, 1, 0), size);
  const Vec lo{-3.5 * size, 0, -size}, hi{-1.5 * size, 1.5 * size, size};
  const auto face = [&](const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
    text += "p 4";
    for (const Vec& p : {a, b, c, d}) text += frame(p);
    text += "\n";
  };
  face({lo.x, hi.y, lo.z}, {lo.x, hi.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, hi.y, lo.z});
  face({lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z});
  face({hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, hi.y, hi.z}, {hi.x, lo.y, hi.z});
  return text;
}

std::string describe_faces(const Frame& frame, std::initializer_list<std::vector<Vec>> faces) {
  std::string text = "f 0.8 0.8 0.8 1 0 0 0 1\n";
  for (const auto& corners : faces) {
    text += fmt::format("p {}", corners.size());
    for (const Vec& p : corners) text += frame(p);
    text += "\n";
  }
  return text;
}

std::string describe_square(double e, const Frame& frame = {}) {
  return describe_faces(frame, {{{-e, 0, -e}, {-e, 0, e}, {e, 0, e}, {e, 0, -e}}});
}

std::string describe_triangles(double e, const Frame& frame = {}) {
  return describe_faces(
      frame, {{{-e, 0, -e}, {-e, 0, e}, {e, 0, e}}, {{-e, 0, -e}, {e, 0, e}, {e, 0, -e}}});
}

std::string describe_ball(double extent, const Frame& frame = {}) {
  return fmt::format("f 0.8 0.8 0.8 1 0 0 0 1\ns{} {}\n", frame({0, -extent, 0}), extent);
}

Samples render_with(const std::string& objects, const std::string& ground) {
  return render(parse(objects + ground), make_params(48, 48, 6)).samples;
}

// The fraction of pixels that differ by more than 1 %.
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
      const Samples expected = render_with(objects, describe(1e5 * size, {}));
      for (const double extent : {1e7, 1e9, 1e10, 1e12}) {
        // The surface of a huge ball is rounded to 1e-16 of its radius; the plane y = 0 is exact.
        if (describe == &describe_ball && extent > 1e10) continue;
        SCOPED_TRACE(fmt::format("size {}, ground {} times", size, extent));
        EXPECT_LT(compare(render_with(objects, describe(extent * size, {})), expected), 0.01);
      }
    }
  }
}

// Tilted grounds, some of them far from the origin. Their corners are rounded to 1e-16 of their
// coordinates, which moves the ground by this amount.
TEST(Scale, ATiltedHugeGroundHidesNothing) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const double distance : {0.0, 1e3, 1e6}) {
      const Frame frame = make_frame(seed, distance);
      const std::string objects = describe_objects(1, frame);
      for (const auto describe : {&describe_square, &describe_triangles}) {
        const Samples expected = render_with(objects, describe(1e5, frame));
        for (const double extent : {1e7, 1e9, 1e10, 1e11, 1e12}) {
          SCOPED_TRACE(fmt::format("seed {}, at {}, ground {}, {}", seed, distance, extent,
                                   describe == &describe_square));
          EXPECT_LT(compare(render_with(objects, describe(extent, frame)), expected), 0.01);
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

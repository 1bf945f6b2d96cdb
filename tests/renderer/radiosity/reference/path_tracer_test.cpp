// Tests that the reference path tracer agrees with closed forms within its standard error, and that
// the standard error is right.

#include "tests/reference/path_tracer.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/light/closed_forms.hpp"
#include "tests/renderer/radiosity/show/pictures.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::reference {
namespace {

using test::add_quad;
using test::grey;

double mean(const Rgb& colour) { return (colour.r + colour.g + colour.b) / 3; }

TracerParams make_params(int width, int height, int samples) {
  TracerParams params;
  params.width = width;
  params.height = height;
  params.samples = samples;
  return params;
}

void look(Room& room, const Vec& from, const Vec& at, const Vec& up, double angle) {
  room.view = {from, at, up, angle};
}

// Compares pictures for many seeds with the expected value of each pixel. Their mean must be right,
// and so must the standard error of each pixel. The standard error is computed from n rounds of
// paths. Therefore, the error divided by the standard error has the variance (n - 1) / (n - 3)
// (Student's distribution).
void expect_within_noise(const Room& room, TracerParams params, const std::vector<double>& expected,
                         const std::string& what) {
  constexpr int SEEDS = 16;
  const auto pixels = static_cast<double>(expected.size());
  double sum = 0, squares = 0, students = 0, whole = 0;
  for (const double value : expected) whole += value / pixels;
  for (params.seed = 1; params.seed <= SEEDS; ++params.seed) {
    const Reference made = trace_paths(room, params);
    double off = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double here = mean(made.picture.pixels[i]) - expected[i];
      ASSERT_GT(made.error[i], 0) << what << ", pixel " << i;
      off += here / pixels;
      students += here * here / (made.error[i] * made.error[i]) / pixels / SEEDS;
    }
    sum += off / SEEDS;
    squares += off * off / SEEDS;
  }
  const double error = std::sqrt((squares - sum * sum) / (SEEDS - 1));
  const double spread = std::sqrt(students / (7.0 / 5));
  fmt::print(
      "{}: off by {:.4f} %, standard error {:.4f} %; differences of pixels are {:.2f} of "
      "their standard errors\n",
      what, 100 * sum / whole, 100 * error / whole, spread);
  EXPECT_LT(std::abs(sum), 4 * error) << what;
  EXPECT_LT(error, 0.005 * whole) << what;
  EXPECT_GT(spread, 0.85) << what;
  EXPECT_LT(spread, 1.2) << what;
}

TEST(PathTracer, FurnaceHasItsClosedForm) {
  // If every face emits E and reflects rho, the radiosity is E / (1 - rho) everywhere.
  for (const double rho : {0.3, 0.9}) {
    test::Random random{7};
    Room room = test::make_furnished(random, 3, 1);
    room.materials[0].reflectance = grey(rho);
    look(room, {0.1, 0.1, 1.2}, {1, 1, 0.6}, {0, 0, 1}, 80);
    expect_within_noise(room, make_params(12, 8, 64), std::vector<double>(12 * 8, 1 / (1 - rho)),
                        fmt::format("furnace of {}", rho));
  }
}

// A floor, to which tests add objects, as seen from above.
Room make_floor(double size) {
  Room room;
  room.materials = {
      {"floor", grey(0.5), {}}, {"lamp", {}, grey(3)}, {"glass", grey(0.8), {}, true}};
  add_quad(room, 0, {0, 0, 0}, {size, 0, 0}, {0, size, 0});
  look(room, {size / 2, size / 2, 9}, {size / 2, size / 2, 0}, {0, 1, 0}, 6);
  return room;
}

std::vector<double> eval_floor(const Room& room, const TracerParams& params, const auto& f) {
  PictureParams size;
  size.width = params.width;
  size.height = params.height;
  std::vector<double> expected;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Vec way = test::eval_way(room.view, size, x, y);
      expected.push_back(f(room.view.from + (-room.view.from.z / way.z) * way));
    }
  return expected;
}

TEST(PathTracer, DirectLightHasItsClosedForm) {
  // The radiosity must be B = rho E F, with the form factor F. One lamp is distant; the other
  // stands on the floor, where F approaches 1/2.
  Room room = make_floor(1);
  add_quad(room, 1, {0.1, -1.5, 2}, {0, 1, 0.3}, {1, 0, 0});
  add_quad(room, 1, {-0.02, 0, 0}, {0, 1, 0}, {0, 0, 0.5});
  const auto params = make_params(12, 12, 512);
  const auto expected = eval_floor(room, params, [&](const Vec& at) {
    double factor = 0;
    for (const std::size_t lamp : {1, 2})
      factor += test::closed::polygon(at, {0, 0, 1}, room.faces[lamp].corners);
    return 0.5 * 3 * factor;
  });
  expect_within_noise(room, params, expected, "direct light");
}

TEST(PathTracer, MirrorShowsALampTwice) {
  // The radiosity must be B = rho E (F + m F'). F' is the form factor of the lamp's image behind a
  // mirror. The mirror is larger than this image.
  Room room = make_floor(1);
  add_quad(room, 1, {1, -1, 0.5}, {0, 3, 0}, {0, 0, 2});
  // the lamp shines towards the mirror and the floor
  std::ranges::reverse(room.faces.back().corners);
  add_quad(room, 2, {-1, -9, -9}, {0, 19, 0}, {0, 0, 19});
  const auto params = make_params(12, 12, 512);
  auto image = room.faces[1].corners;
  for (Vec& corner : image) corner.x = -2 - corner.x;
  const auto expected = eval_floor(room, params, [&](const Vec& at) {
    return 0.5 * 3 *
           (test::closed::polygon(at, {0, 0, 1}, room.faces[1].corners) +
            0.8 * test::closed::polygon(at, {0, 0, 1}, image));
  });
  expect_within_noise(room, params, expected, "mirror");
}

TEST(PathTracer, BacksAreBlackAndBackToBackShowTheirFronts) {
  Room room = make_floor(1);
  add_quad(room, 1, {0, 0, 1}, {0.5, 0, 0}, {0, 1, 0});    // a face whose front is visible
  add_quad(room, 1, {0.5, 0, 1}, {0, 1, 0}, {0.5, 0, 0});  // a face whose back is visible
  add_quad(room, 1, {0, 0, 1}, {0, 0.5, 0}, {0.5, 0, 0});  // a face behind the first one
  const auto made = trace_paths(room, make_params(8, 8, 8));
  for (std::size_t i = 0; i < 64; ++i) {
    const bool left = i % 8 < 4;
    EXPECT_EQ(mean(made.picture.pixels[i]), left ? 3 : 0);
    EXPECT_EQ(made.emits[i], left);
    EXPECT_EQ(made.faces[i] != 0, left);
  }
}

TEST(PathTracer, IsTheSameForAnyNumberOfThreads) {
  test::Random random{3};
  Room room = test::make_furnished(random, 3, 1);
  look(room, {0.1, 0.1, 1.2}, {1, 1, 0.6}, {0, 0, 1}, 80);
  TracerParams params = make_params(9, 7, 16);
  params.threads = 1;
  const auto one = trace_paths(room, params);
  params.threads = 3;
  const auto three = trace_paths(room, params);
  EXPECT_EQ(one.picture, three.picture);
  EXPECT_EQ(one.error, three.error);
  EXPECT_EQ(one.faces, three.faces);
}

}  // namespace
}  // namespace radiosity::reference

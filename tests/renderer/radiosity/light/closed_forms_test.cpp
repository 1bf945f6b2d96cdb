// Compares form factors with closed forms. Sizes and distances are in units of the first side. Each
// test prints seven errors: with 1, 4, 16, 64, 256 and 1024 samples, and with default parameters.

#include "tests/renderer/radiosity/light/closed_forms.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

constexpr double DISTANCES[] = {0.5, 1, 2};
constexpr Vec ORIGIN{0, 0, 0}, UP{0, 0, 1};

Mesh make_lamp(const Face& face, int n = 1) {
  Room room;
  room.materials = {{"lamp", grey(0), grey(1)}};
  room.faces = {face};
  return make_mesh(room, {.refine = n});
}
Face make_quad(const Vec& p, const Vec& a, const Vec& b) {
  Room room;
  return add_quad(room, 0, p, a, b);
}
// A regular polygon with the area of a disc of the given radius.
Face make_disc(double z, const Vec& axis, double radius, int corners) {
  const double share = corners / (2 * closed::PI) * std::sin(2 * closed::PI / corners);
  Face face;
  face.corners = make_ring({0, 0, z}, axis, radius / std::sqrt(share), corners);
  return face;
}

// Relative errors of one form factor. `eval` computes it as a sum over the patches of a mesh.
struct Errors {
  Errors(const Mesh& lamp, double exact, const std::function<double(const Eye&)>& eval) {
    for (const int samples : {1, 2, 4, 8, 16, 32})
      fixed.push_back(eval({lamp, {.samples = samples, .halvings = 0}}) / exact - 1);
    adaptive = eval({lamp, {}}) / exact - 1;
    both = eval({lamp, {.samples = 8}}) / exact - 1;
    std::string line;
    for (const double e : fixed) line += fmt::format(" {:+.5f}", e);
    fmt::print("{:.6f}:{} {:+.5f}\n", exact, line, adaptive);
  }
  // Limits the errors with 64 samples and with default parameters. With twice as many samples along
  // a side, the error must be at most a tenth.
  void expect_small_and_converging() const {
    EXPECT_LT(std::abs(fixed[3]), 0.02);
    EXPECT_LT(std::abs(adaptive), 0.01);
    for (const std::size_t k : {3u, 4u})
      EXPECT_LT(std::abs(fixed[k + 1]), std::max(std::abs(fixed[k]) / 10, 1e-5));
  }
  std::vector<double> fixed;
  // `adaptive` is the error with default parameters. `both` is the error with 64 delta areas, which
  // are halved where they are wide.
  double adaptive = 0, both = 0;
};

Errors find_errors(const Face& face, double exact) {
  const Mesh lamp = make_lamp(face);
  return {lamp, exact, [](const Eye& eye) { return sum_factors(eye, make_point(ORIGIN, UP)); }};
}

TEST(ClosedForms, OfAPointAndAParallelRectangle) {
  for (const double c : DISTANCES)
    find_errors(make_quad({0, 0, c}, {0, 1.5, 0}, {1, 0, 0}), closed::parallel_rectangle(1, 1.5, c))
        .expect_small_and_converging();
}

TEST(ClosedForms, OfAPointAndAnUprightRectangle) {
  for (const double c : DISTANCES)
    find_errors(make_quad({c, 0, 0}, {0, 0, 1}, {0, 1.5, 0}), closed::upright_rectangle(1, 1.5, c))
        .expect_small_and_converging();
}

// Delta areas may have any shape, and may be seen from anywhere. Halving their sides must reduce
// the error to about 1/16.
TEST(ClosedForms, DeltaAreasAreExactToTheSecondOrder) {
  double coarse = 0, fine = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random{seed};
    const auto shake = [&](double x, double y) {
      return Vec{x + random.range(-0.3, 0.3), y + random.range(-0.3, 0.3), 2.5};
    };
    Face face;
    face.corners = {shake(-1, -1), shake(-1, 1), shake(1, 1), shake(1, -1)};
    const Mesh lamp = make_lamp(face);
    const Vertex eye = make_point({random.range(-2, 2), random.range(-2, 2), 0},
                                  normalize(Vec{random.range(-0.3, 0.3), 0, 1}));
    const auto eval = [&](int samples) {
      return sum_factors({lamp, {.samples = samples, .halvings = 0}}, eye);
    };
    const double exact = eval(64);
    coarse += std::abs(eval(4) / exact - 1) / 100;
    fine += std::abs(eval(8) / exact - 1) / 100;
  }
  fmt::print("4 x 4 delta areas are off by {:.2g}, 8 x 8 by {:.2g}\n", coarse, fine);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_LT(fine, coarse / 10);
}

// A disc with 64 corners has 64 thin patches.
TEST(ClosedForms, OfAPointAndADisc) {
  for (const double c : DISTANCES)
    find_errors(make_disc(c, -UP, 1, 64), closed::parallel_disc(1, c))
        .expect_small_and_converging();
}

// Errors of form factors between two patches. The mean over 16 x 16 points represents the receiving
// patch within 0.3 %.
Errors find_errors(const Face& from, const Face& to, double exact) {
  const Mesh receiver = make_lamp(from), lamp = make_lamp(to);
  return {lamp, exact, [&](const Eye& eye) {
            double total = 0, area = 0;
            for (const Patch& patch : receiver.patches) {
              const int n = receiver.patches.size() == 1 ? 16 : 4;
              total += patch.area * eval_mean(receiver, patch, n, [&](const Vertex& point) {
                         return sum_factors(eye, point);
                       });
              area += patch.area;
            }
            return total / area;
          }};
}

TEST(ClosedForms, OfParallelRectangles) {
  for (const double c : DISTANCES) {
    const auto errors = find_errors(make_quad(ORIGIN, {1, 0, 0}, {0, 1.5, 0}),
                                    make_quad({0, 0, c}, {0, 1.5, 0}, {1, 0, 0}),
                                    closed::parallel_rectangles(1, 1.5, c));
    EXPECT_LT(std::abs(errors.fixed[3]), 0.02);
    EXPECT_LT(std::abs(errors.fixed[5]), 0.003);
    EXPECT_LT(std::abs(errors.adaptive), 0.01);
  }
}

// Near the common edge, a 64th of a patch is wider than its distance from the lit point. With equal
// delta areas, the error is up to 9 %; if wide ones are halved, it is 0.5 %.
TEST(ClosedForms, OfUprightRectanglesWithAnEdgeInCommon) {
  for (const double height : DISTANCES) {
    const auto errors = find_errors(make_quad(ORIGIN, {1, 0, 0}, {0, 1, 0}),
                                    make_quad(ORIGIN, {0, 1, 0}, {0, 0, height}),
                                    closed::upright_rectangles(1, height, 1));
    EXPECT_LT(std::abs(errors.fixed[3]), 0.09);
    EXPECT_LT(std::abs(errors.fixed[4]), 0.7 * std::abs(errors.fixed[3]));
    EXPECT_LT(std::abs(errors.fixed[5]), 0.02);
    EXPECT_LT(std::abs(errors.adaptive), 0.005);
    EXPECT_LT(std::abs(errors.both), 0.005);
  }
}

TEST(ClosedForms, OfCoaxialDiscs) {
  for (const double c : DISTANCES) {
    const auto errors = find_errors(make_disc(0, UP, 0.7, 16), make_disc(c, -UP, 1, 16),
                                    closed::coaxial_discs(0.7, 1, c));
    EXPECT_LT(std::abs(errors.fixed[3]), 0.02);
    EXPECT_LT(std::abs(errors.fixed[5]), 0.002);
    EXPECT_LT(std::abs(errors.adaptive), 0.01);
  }
}

}  // namespace
}  // namespace radiosity::test

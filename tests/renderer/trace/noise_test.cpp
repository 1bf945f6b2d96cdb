// Tests that noise decreases with the number of samples, for all quantities over which rays are
// distributed.

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr int WIDTH = 20;

double eval_rmse(const Samples& a, const Samples& b) {
  double sum = 0;
  for (std::uint32_t i = 0; i < a.sums.size(); ++i) {
    const Rgb x = a.get(i), y = b.get(i);
    for (const auto component : {&Rgb::r, &Rgb::g, &Rgb::b})
      sum += (x.*component - y.*component) * (x.*component - y.*component);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a.sums.size())));
}

Samples render_with(const Scene& scene, int samples, std::uint64_t seed) {
  Params params = make_params(WIDTH, WIDTH, 4);
  params.sample = SamplePosition::center;
  params.sampling.pixel_samples = samples;
  params.sampling.seed = seed;
  return render(scene, params, 2).samples;
}

// The slope of log(error) as a function of log(samples), by least squares.
double eval_slope(const std::vector<std::pair<int, double>>& errors) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(errors.size());
  for (const auto& [samples, error] : errors) {
    const double a = std::log(samples), b = std::log(error);
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

struct Effect {
  const char* name;
  const char* scene;  // NFF text of the scene, after the view
};
class Noise : public testing::TestWithParam<Effect> {};

const std::string SPHERES =
    "s -0.9 0.2 0 0.5\nf 0.2 0.9 0.3 1 0 1 0 0\ns 0.7 -0.5 -1 0.7\ns 0.2 0.8 1 0.3\n"
    "f 0.9 0.1 0.2 1 0 1 0 0\ns -0.4 -0.8 1.5 0.35\ns 0.9 0.7 -3 0.8\n";

TEST_P(Noise, FallsAsTheSquareRootOrFaster) {
  const Scene scene = parse("v from 0 0 6 at 0 0 0 up 0 1 0 angle 35\nb 0.1 0.3 0.6\n" +
                            fmt::format(fmt::runtime(GetParam().scene), SPHERES));
  const Samples reference = render_with(scene, 1600, 99);
  std::vector<std::pair<int, double>> errors;
  for (const int samples : {1, 4, 16, 64})
    errors.emplace_back(samples, eval_rmse(render_with(scene, samples, 7), reference));
  const double slope = eval_slope(errors);
  EXPECT_LT(slope, -0.5) << "the error is about N^slope; that of 64 samples "
                         << errors.back().second;
  EXPECT_LT(errors.back().second, errors.front().second / 8) << "64 samples, sqrt(64) = 8";
}

INSTANTIATE_TEST_SUITE_P(
    Effects, Noise,
    testing::Values(
        Effect{"pixel", "l 3 9 9 1 1 1\nf 0.9 0.6 0.2 1 0 1 0 0\n{}"},
        Effect{"lens", "# lens 0.8 9\nl 3 9 9 1 1 1\nf 0.9 0.6 0.2 1 0 1 0 0\n{}"},
        Effect{"time",
               "# shutter 0 0.5\n# move 2 0.5 0\nl 3 9 9 1 1 1\nf 0.9 0.6 0.2 1 0 1 0 0\n{}"},
        Effect{"light, rectangle",
               "# light rect 1 5 5 3 0 0 0 1 -1 1 1 1\nf 0.9 0.6 0.2 1 0 1 0 0\n"
               "p 4 -9 -9 -2 9 -9 -2 9 9 -2 -9 9 -2\n{}"},
        Effect{"light, sphere",
               "# light sphere 1 5 5 3 1 1 1\nf 0.9 0.6 0.2 1 0 1 0 0\n"
               "p 4 -9 -9 -2 9 -9 -2 9 9 -2 -9 9 -2\n{}"},
        Effect{"gloss",
               "l 0 0 9 1 1 1\nf 0 0 0 0 0.9 1 0 0\n# gloss 0.3\n"
               "p 4 -9 -2 -9 9 -2 -9 9 1 5 -9 1 5\nf 0.9 0.6 0.2 1 0 1 0 0\n{}"},
        Effect{"translucency",
               "l 0 0 9 1 1 1\nf 0 0 0 0 0 1 0.9 1\n# translucent 0.3\n"
               "p 4 -9 -9 2.5 9 -9 2.5 9 9 2.5 -9 9 2.5\nf 0.9 0.6 0.2 1 0 1 0 0\n{}"}),
    [](const auto& effect) {
      std::string name = effect.param.name;
      std::erase_if(name, [](char c) { return c == ' ' || c == ','; });
      return name;
    });

}  // namespace
}  // namespace renderer::test

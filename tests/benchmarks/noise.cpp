// Time to render a picture with a lens and an area light until its error is below a given value.
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/quality/quality.hpp"
#include "renderer/scene/generators.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/renderers.hpp"

namespace benchmarks {

using namespace renderer;

namespace {

constexpr int SIZE = 96;
// samples per pixel of tlab's picture; its error is the value that POV-Ray must reach
constexpr int OURS = 16;
constexpr int REFERENCE = 256;  // samples per pixel of the pictures that count as exact

Scene make_scene() {
  Scene scene = make_spheres(800);
  View& view = scene.view;
  const double distance = length(view.at - view.from);
  view.lens = {0.03 * distance, distance};
  for (Light& light : scene.lights) {
    light.shape = LightShape::rectangle;
    const Across across = make_across(normalize(light.at - view.at));
    const double half = 0.1 * length(light.at - view.at);
    light.u = half * across.u;
    light.v = half * across.v;
  }
  finish(scene);
  return scene;
}

Params make_params(int samples, std::uint64_t seed) {
  Params params;
  params.width = params.height = SIZE;
  params.limits.depth = 5;
  params.feelers = Feelers::front;  // only to lights on the visible side, as in POV-Ray
  params.sample = SamplePosition::center;
  params.traversal = Traversal::nearest;
  params.sampling.pixel_samples = samples;
  params.sampling.seed = seed;
  return params;
}

// The error to reach, and the number of samples that POV-Ray needs for it. The error of each
// program is measured against its own exact picture, because the programs sample pixels in
// different ways: POV-Ray's camera rays go through the middles of pixels.
class Contest {
 public:
  const Scene scene = make_scene();
  double error = 0;        // error of tlab's picture with OURS samples per pixel
  double apart = 0;        // difference between the exact pictures of the two programs
  PovraySamples theirs;    // the numbers of samples with which POV-Ray reaches the error fastest
  double their_error = 0;  // error of POV-Ray's picture with these samples

  Contest() {
    const Samples ours = render(scene, make_params(REFERENCE, 2)).samples;
    error = rms_difference(render(scene, make_params(OURS, 1)).samples, ours);
    reference_ = run({REFERENCE, 2}).image;
    apart = rms_difference(ours, reference_);
    double least = std::numeric_limits<double>::infinity();
    for (const int side : {2, 4})
      if (const auto found = find_samples(side); found && found->cpu_s < least) {
        least = found->cpu_s;
        theirs = found->samples;
        their_error = found->error;
      }
    if (their_error == 0) throw std::runtime_error("povray: does not reach the error");
  }

  PovrayRun run(const PovraySamples& samples) const {
    return run_povray(scene, make_params(1, 1), samples, temporary_folder());
  }

 private:
  struct Tried {
    PovraySamples samples;
    double error = 0, cpu_s = 0;
  };
  Tried attempt(const PovraySamples& samples) const {
    const PovrayRun made = run(samples);
    return {samples, rms_difference(made.image, reference_), made.sample.cpu_s};
  }
  // Finds the number of camera rays per pixel that reaches the error with `side` x `side` shadow
  // feelers. Doubles the number until the error is reached, and then interpolates between the last
  // two numbers.
  std::optional<Tried> find_samples(int side) const {
    Tried before = attempt({4, side});
    while (before.samples.lens < REFERENCE / 2) {
      const Tried tried = attempt({2 * before.samples.lens, side});
      if (tried.error > error) {
        before = tried;
        continue;
      }
      const double share = std::log(before.error / error) / std::log(before.error / tried.error);
      const int lens = static_cast<int>(std::ceil(before.samples.lens * std::pow(2, share)));
      return attempt({lens, side});
    }
    return std::nullopt;
  }

  Samples reference_;
};

const Contest& contest() {
  static const Contest made;
  return made;
}

}  // namespace

void add_noise() {
  const std::string what = "pixels of one error, lens and area light";
  add(what, "tlab", [](benchmark::State& state) {
    const Params params = make_params(OURS, 1);
    state.counters["rmse"] = contest().error;
    const double cpu_s = time_of([&] { render(contest().scene, params); });
    return Sample{SIZE * SIZE, cpu_s};
  });
  add(what, "povray", [](benchmark::State& state) {
    state.counters["camera_rays"] = contest().theirs.lens;
    state.counters["feelers"] = std::pow(contest().theirs.light_side, 2);
    state.counters["rmse"] = contest().their_error;
    state.counters["apart"] = contest().apart;
    return Sample{SIZE * SIZE, contest().run(contest().theirs).sample.cpu_s};
  });
}

}  // namespace benchmarks

#pragma once
// Other ray tracers on tlab's scenes.
#include <string>
#include <vector>

#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"
#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

struct PovrayRun {
  Sample sample;  // rays traced, including shadow rays
  renderer::Samples image;
};

struct PovraySamples {
  int lens = 1;        // camera rays per pixel, spread over the lens
  int light_side = 1;  // square root of the number of feelers to an area light
};

// Renders the same view, spheres, floor and lights with POV-Ray: one thread, camera rays through
// the centres of pixels, no limit but the depth. Writes its files into `folder`.
PovrayRun run_povray(const renderer::Scene& scene, const renderer::Params& params,
                     const PovraySamples& samples, const std::string& folder);

// A folder that is removed when the program ends.
const std::string& temporary_folder();

struct HitSample {
  Sample sample;
  std::uint64_t hits = 0;  // rays that hit something
};

// Answers the same queries with Embree 3, one by one, on one thread and in single precision: the
// first hit of every ray, any hit of a shadow feeler. There is no shading, so the speed is an upper
// bound.
HitSample run_embree(const renderer::Scene& scene, const std::vector<renderer::Ray>& rays);

}  // namespace benchmarks

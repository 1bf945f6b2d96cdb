#pragma once
// Other ray tracers, which render tlab's scenes.
#include <string>
#include <vector>

#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"
#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

struct PovrayRun {
  Sample sample;  // number of rays, including shadow rays
  renderer::Samples image;
};

struct PovraySamples {
  int lens = 1;        // camera rays per pixel, spread over the lens
  int light_side = 1;  // square root of the number of shadow feelers to an area light
};

// Renders the view, spheres, floor and lights of the scene with POV-Ray. POV-Ray uses one thread
// and sends camera rays through the centres of pixels; only the depth limits its shading trees.
// Writes POV-Ray's files into `folder`.
PovrayRun run_povray(const renderer::Scene& scene, const renderer::Params& params,
                     const PovraySamples& samples, const std::string& folder);

// A folder that is removed at the end of the program.
const std::string& temporary_folder();

struct HitSample {
  Sample sample;
  std::uint64_t hits = 0;  // number of rays that hit something
};

// Intersects `rays` with Embree 3 or 4, one by one, with one thread and in single precision: finds
// the first hit of a ray, or any hit of a shadow feeler. Nothing is shaded, so the measured speed
// is an upper bound.
HitSample run_embree(const renderer::Scene& scene, const std::vector<renderer::Ray>& rays);

}  // namespace benchmarks

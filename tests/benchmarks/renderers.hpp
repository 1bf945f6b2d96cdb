#pragma once
// Other ray tracers on our scenes.
#include <string>
#include <vector>

#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"
#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

struct PovrayRun {
  Sample sample;  // rays traced, shadow rays included
  renderer::Samples image;
};

struct PovraySamples {
  int lens = 1;        // camera rays of a pixel, all over the lens
  int light_side = 1;  // a light that has a size gets so many times as many feelers
};

// POV-Ray renders the same view of the same spheres, floor and lights: one thread, camera rays
// through each pixel's centre, no cut-off but the depth. Writes its files into `folder`.
PovrayRun run_povray(const renderer::Scene& scene, const renderer::Params& params,
                     const PovraySamples& samples, const std::string& folder);

// A folder that is removed when all is over.
const std::string& temporary_folder();

struct HitSample {
  Sample sample;
  std::uint64_t hits = 0;  // rays that met something
};

// Embree 3 answers the same queries one by one, on one thread and in single precision: the first
// hit of every ray, any hit of a shadow feeler. No shading: an upper mark.
HitSample run_embree(const renderer::Scene& scene, const std::vector<renderer::Ray>& rays);

}  // namespace benchmarks

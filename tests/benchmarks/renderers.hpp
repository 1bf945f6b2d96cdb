#pragma once
// Other ray tracers on tlab's scenes.
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
  int lens = 1;        // camera rays a pixel, spread over the lens
  int light_side = 1;  // an area light gets this number, squared, of feelers
};

// POV-Ray renders the same view, spheres, floor and lights: one thread, camera rays through pixel
// centres, no cut-off but the depth. Writes its files into `folder`.
PovrayRun run_povray(const renderer::Scene& scene, const renderer::Params& params,
                     const PovraySamples& samples, const std::string& folder);

// A folder that is removed when the program ends.
const std::string& temporary_folder();

struct HitSample {
  Sample sample;
  std::uint64_t hits = 0;  // rays that met something
};

// Embree 3 answers the same queries one by one, on one thread and in single precision: the first
// hit of every ray, any hit of a shadow feeler. No shading: an upper bound.
HitSample run_embree(const renderer::Scene& scene, const std::vector<renderer::Ray>& rays);

}  // namespace benchmarks

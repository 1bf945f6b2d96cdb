#pragma once
// Other ray tracers on our scenes.
#include <string>
#include <vector>

#include "experiments/benchmarks/measure.hpp"
#include "renderer/render.hpp"

namespace benchmarks {

struct PovrayRun {
  Sample sample;                         // rays traced, shadow rays included
  std::uint64_t rays = 0, shadow = 0;    // of those: eye and reflected, shadow
  double difference = 0, differing = 0;  // of its image from ours: mean of 0..255, share of
                                         // colour values more than 8 apart
};

// POV-Ray renders the same view of the same spheres, floor and lights: one thread, one sample at
// each pixel's centre, no cut-off but the depth. Writes NAME.pov and NAME.ppm into `folder`.
PovrayRun run_povray(const renderer::Scene& scene, const renderer::Params& params,
                     const renderer::Samples& ours, const std::string& folder,
                     const std::string& name, int runs);

struct EmbreeRun {
  Sample sample;
  std::uint64_t hits = 0;  // rays that met something
};

// Embree 3 answers the same queries one by one, on one thread and in single precision: the first
// hit of every ray, any hit of a shadow feeler. No shading: an upper mark.
EmbreeRun run_embree(const renderer::Scene& scene, const std::vector<renderer::Ray>& rays,
                     int runs);

}  // namespace benchmarks

#pragma once
// Other ray tracers on our scenes.
#include <string>
#include <vector>

#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"
#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

struct PovrayRun {
  Sample sample;                         // rays traced, shadow rays included
  double difference = 0, differing = 0;  // of its image from ours: mean of 0..255, share of
                                         // colour values more than 8 apart
};

// POV-Ray renders the same view of the same spheres, floor and lights: one thread, one sample at
// each pixel's centre, no cut-off but the depth. Writes its files into `folder`.
PovrayRun run_povray(const renderer::Scene& scene, const renderer::Params& params,
                     const renderer::Samples& ours, const std::string& folder);

struct HitSample {
  Sample sample;
  std::uint64_t hits = 0;  // rays that met something
};

// Embree 3 answers the same queries one by one, on one thread and in single precision: the first
// hit of every ray, any hit of a shadow feeler. No shading: an upper mark.
HitSample run_embree(const renderer::Scene& scene, const std::vector<renderer::Ray>& rays);

}  // namespace benchmarks

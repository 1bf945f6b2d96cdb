#pragma once
// A reference for progressive radiosity: solves the same equations by gathering light at each
// vertex.

#include "renderer/radiosity/mesh/mesh.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {

// The radiosity of a vertex lit by all patches (thesis Eq 1.8). In `patches`, the light of every
// patch is stored as unsent light.
inline Rgb collect(const Eye& eye, const Vertex& vertex, const State& patches, Work& work) {
  const Mesh& mesh = eye.mesh;
  const Material& material = mesh.materials[vertex.material];
  Rgb incident;
  for (std::uint32_t j = 0; j < mesh.patches.size(); ++j)
    if (const auto all = find_shot(mesh, patches, std::array{j}, work))
      incident += eval_light(eye, vertex, {mesh.patches[j], all->glow}, work);
  return material.emission + material.reflectance * incident;
}

// The radiosity of every patch, updated whenever its corners or its centre change.
class PatchLight {
 public:
  PatchLight(const Mesh& mesh, const SolveParams& params)
      : patches(make_state(mesh, params.sends)),
        centres(patches.unshot),
        mesh_(mesh),
        around_(find_surroundings(mesh)),
        of_corner_(params.mean == Mean::corners ? 0.25 : 1.0 / 12) {}
  void change_corner(std::uint32_t vertex, const Rgb& more) {
    for (const auto patch : around_.of(vertex)) {
      patches.unshot[patch] += of_corner_ * more;
      for (std::size_t k = 0; k < 4 && !patches.in_corners.empty(); ++k)
        if (mesh_.patches[patch].corners[k] == vertex) patches.in_corners[patch][k] += more;
    }
  }
  void change_centre(std::uint32_t patch, const Rgb& more) {
    patches.unshot[patch] += (2.0 / 3) * more;
  }

  State patches;
  std::vector<Rgb> centres;

 private:
  const Mesh& mesh_;
  Surroundings around_;
  double of_corner_;
};

// The largest change in a sweep over all vertices, and the largest radiosity.
struct Sweep {
  double change = 0, brightest = 0;

  // Changes `value` to `now`, and returns the difference.
  Rgb set(Rgb& value, const Rgb& now) {
    const Rgb more{now.r - value.r, now.g - value.g, now.b - value.b};
    value = now;
    change = std::max({change, std::abs(more.r), std::abs(more.g), std::abs(more.b)});
    brightest = std::max(brightest, renderer::max_component(now));
    return more;
  }
};

/// Solves the equations of solve() by gathering (thesis Eq 1.8 with Eq 3.9). Sweeps over the
/// vertices, in order, until no change exceeds the fraction `tolerance` of the brightest radiosity.
/// Returns the number of sweeps in `shots`. Every sweep computes every form factor again, so that
/// only small rooms are practical.
inline Solution gather(const Mesh& mesh, const SolveParams& params, double tolerance = 1e-6) {
  check(params.factor);
  const Eye eye{mesh, params.factor};
  PatchLight light(mesh, params);
  Solution solution;
  solution.vertices = light.patches.radiosity;
  for (bool going = true; going; ++solution.shots) {
    Sweep sweep;
    const auto collect_at = [&](const Vertex& vertex, Rgb& value) {
      return sweep.set(value, collect(eye, vertex, light.patches, solution.work));
    };
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
      light.change_corner(v, collect_at(mesh.vertices[v], solution.vertices[v]));
    if (params.mean == Mean::simpson)
      for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
        light.change_centre(p, collect_at(make_centre(mesh.patches[p]), light.centres[p]));
    going = sweep.change > tolerance * sweep.brightest;
  }
  return solution;
}

}  // namespace radiosity::test

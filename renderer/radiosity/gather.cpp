#include <algorithm>
#include <cmath>

#include "renderer/radiosity/solve.hpp"
#include "renderer/radiosity/split.hpp"

namespace radiosity {

namespace {

// What the vertex gets of all patches (Eq 1.8).
Rgb collect(const Eye& eye, const Vertex& vertex, const std::vector<Rgb>& patches,
            renderer::Work& work) {
  const Mesh& mesh = eye.mesh;
  const Material& material = mesh.materials[vertex.material];
  Rgb incident;
  for (std::size_t j = 0; j < patches.size(); ++j)
    if (renderer::max_component(patches[j]) > 0)
      incident += eval_factors(eye, vertex, mesh.patches[j], work) * patches[j];
  return material.emission + material.reflectance * incident;
}

}  // namespace

Solution gather(const Mesh& mesh, const FactorParams& params, double tolerance) {
  check(params);
  const Eye eye{mesh, params};
  const auto around = find_surroundings(mesh);
  State state = make_state(mesh);  // `unshot`: of each patch its radiosity
  Solution solution;
  for (double change = 1; change > tolerance; ++solution.shots) {
    double brightest = change = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      const Rgb old = state.radiosity[v];
      const Rgb now = collect(eye, mesh.vertices[v], state.unshot, solution.work);
      state.radiosity[v] = now;
      const Rgb more{now.r - old.r, now.g - old.g, now.b - old.b};
      for (const auto patch : around.of(v)) state.unshot[patch] += 0.25 * more;
      const double most = std::max({std::abs(more.r), std::abs(more.g), std::abs(more.b)});
      change = std::max(change, most);
      brightest = std::max(brightest, renderer::max_component(now));
    }
    change /= brightest;
  }
  solution.vertices = std::move(state.radiosity);
  return solution;
}

}  // namespace radiosity

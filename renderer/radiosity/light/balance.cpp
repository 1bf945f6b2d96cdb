#include "renderer/radiosity/light/balance.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/trace/intersect.hpp"
#include "renderer/trace/sampling.hpp"

namespace radiosity {

using renderer::Work;

namespace {

double eval_power(const Mesh& mesh, std::span<const Rgb> patches) {
  double power = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) power += mesh.patches[p].area * sum(patches[p]);
  return power;
}

}  // namespace

Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent) {
  const double unit = 1 / sum(mesh.emitted);
  std::vector<Rgb> reflected;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    reflected.push_back(mesh.materials[mesh.patches[p].material].reflectance * arrived[p]);
  Balance balance;
  balance.reflected = unit * eval_power(mesh, reflected);
  balance.absorbed = unit * eval_power(mesh, arrived) - balance.reflected;
  balance.unsent = unit * eval_power(mesh, unsent);
  balance.escaped = 1 - balance.absorbed - balance.unsent;
  return balance;
}

bool is_closed(const Mesh& mesh) {
  if (!mesh.mirrors.empty()) return false;
  std::vector<std::vector<Vec>> normals(renderer::object_count(mesh.blockers));
  for (const Patch& patch : mesh.patches) {  // one for each side of a face
    auto& sides = normals[patch.object];
    if (std::ranges::none_of(sides, [&](const Vec& n) { return dot(n, patch.normal) > 0; }))
      sides.push_back(patch.normal);
  }
  Work work;
  constexpr int SIDE = 4;
  return std::ranges::all_of(mesh.patches, [&](const Patch& patch) {
    const auto [u, v] = renderer::make_across(patch.normal);
    for (int i = 0; i < SIDE; ++i)
      for (int j = 0; j < SIDE; ++j) {
        const auto [x, y] = renderer::map_to_disc({(i + 0.5) / SIDE, (j + 0.5) / SIDE});
        renderer::Ray ray;
        ray.origin = patch.centre;
        ray.direction = std::sqrt(std::max(0.0, 1 - x * x - y * y)) * patch.normal + x * u + y * v;
        ray.from = patch.object;
        const auto hit = intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
        if (!hit || std::ranges::none_of(normals[hit->object], [&](const Vec& normal) {
              return dot(normal, ray.direction) < 0;
            }))
          return false;
      }
    return true;
  });
}

}  // namespace radiosity

#include "renderer/radiosity/light/balance.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "renderer/radiosity/light/delta_areas.hpp"
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

// The fractions of a patch's light that fall on the backs of faces, and that leave the room.
struct Exits {
  double backs = 0, outside = 0;
};

// Normals of the visible sides of each object in Mesh::blockers: one for a face, two for a
// two-sided face, none for a mirror.
std::vector<std::vector<Vec>> find_fronts(const Mesh& mesh) {
  std::vector<std::vector<Vec>> fronts(renderer::object_count(mesh.blockers));
  for (const Patch& patch : mesh.patches) {
    auto& sides = fronts[patch.object];
    if (std::ranges::none_of(sides, [&](const Vec& n) { return dot(n, patch.normal) > 0; }))
      sides.push_back(patch.normal);
  }
  return fronts;
}

// True if the ray meets a face in contact with the patch, such as the floor on which a block
// stands.
bool meets_contact(const Mesh& mesh, const Patch& patch, renderer::Ray ray, Work& work) {
  const double aside = 1e-6 * std::sqrt(patch.area);
  ray.origin = ray.origin - aside * patch.normal;
  const auto hit = intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
  return hit && hit->distance * dot(ray.direction, patch.normal) < 2 * aside;
}

// Casts side x side rays from random points of the patch number `p`. Each ray stands for an equal
// part of the patch's light.
Exits find_exits(const Mesh& mesh, const std::vector<std::vector<Vec>>& fronts, std::size_t p,
                 std::size_t side) {
  const Patch& patch = mesh.patches[p];
  const Quad quad(patch);
  const auto [u, v] = renderer::make_across(patch.normal);
  Exits exits;
  Work work;
  for (std::size_t i = 0; i < side * side; ++i) {
    const auto random = [&](std::uint64_t number) {
      return 0x1p-53 * static_cast<double>(base::random_at(p, 4 * i + number) >> 11);
    };
    const auto share = [&](std::size_t cell, std::uint64_t number) {
      return (static_cast<double>(cell) + random(number)) / static_cast<double>(side);
    };
    const auto [x, y] = renderer::map_to_disc({share(i / side, 0), share(i % side, 1)});
    renderer::Ray ray;
    ray.origin = quad.eval(random(2), random(3));
    ray.direction = std::sqrt(std::max(0.0, 1 - x * x - y * y)) * patch.normal + x * u + y * v;
    ray.from = patch.object;
    const auto hit = intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
    if (!hit)
      exits.outside += meets_contact(mesh, patch, ray, work) ? 0 : 1;
    else if (std::ranges::none_of(fronts[hit->object], [&](const Vec& normal) {
               return dot(normal, ray.direction) < 0;
             }))
      exits.backs += 1;
  }
  const auto rays = static_cast<double>(side * side);
  return {exits.backs / rays, exits.outside / rays};
}

constexpr std::size_t LEAST_SIDE = 4, MOST_SIDE = 64;

// Estimates the power that falls on the backs of faces if the patches send the radiosities `sent`.
// Casts 16 rays from each patch, and more from patches with more than the mean power.
double find_backs(const Mesh& mesh, std::span<const Rgb> sent) {
  const auto fronts = find_fronts(mesh);
  const double mean = eval_power(mesh, sent) / static_cast<double>(sent.size());
  double power = 0;
  for (std::size_t p = 0; p < sent.size(); ++p) {
    const double own = mesh.patches[p].area * sum(sent[p]);
    if (!(own > 0)) continue;
    const auto side = static_cast<std::size_t>(
        std::clamp(LEAST_SIDE * std::sqrt(own / mean), 1.0 * LEAST_SIDE, 1.0 * MOST_SIDE));
    power += find_exits(mesh, fronts, p, side).backs * own;
  }
  return power;
}

}  // namespace

Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent) {
  const double unit = 1 / sum(mesh.emitted);
  std::vector<Rgb> reflected, sent;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const Material& material = mesh.materials[mesh.patches[p].material];
    reflected.push_back(material.reflectance * arrived[p]);
    sent.push_back(material.emission + reflected[p] - unsent[p]);
  }
  Balance balance;
  balance.reflected = unit * eval_power(mesh, reflected);
  balance.absorbed = unit * eval_power(mesh, arrived) - balance.reflected;
  balance.unsent = unit * eval_power(mesh, unsent);
  balance.escaped = 1 - balance.absorbed - balance.unsent;
  if (mesh.mirrors.empty()) balance.backs = unit * find_backs(mesh, sent);
  return balance;
}

bool is_closed(const Mesh& mesh) {
  if (!mesh.mirrors.empty()) return false;
  const auto fronts = find_fronts(mesh);
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    if (find_exits(mesh, fronts, p, LEAST_SIDE).outside > 0) return false;
  return true;
}

}  // namespace radiosity

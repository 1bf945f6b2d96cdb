// Tests rays and vertices that are processed together in SIMD lanes.

#include "renderer/radiosity/light/receivers.hpp"

#include <gtest/gtest.h>

#include "renderer/trace/shadow_rays.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

using renderer::Bounds;
using renderer::LANES;

template <class Thing>
const Thing& pick(Random& random, const std::vector<Thing>& things) {
  return things[static_cast<std::size_t>(random.below(static_cast<int>(things.size())))];
}

// A random position in the room, often exactly on a wall or at the height of an edge.
Vec make_place(Random& random, const Bounds& bounds) {
  const auto choose = [&](double lo, double hi) {
    return random.below(4) == 0 ? lo : random.range(lo, hi);
  };
  return {choose(bounds.lo.x, bounds.hi.x), choose(bounds.lo.y, bounds.hi.y),
          choose(bounds.lo.z, bounds.hi.z)};
}

renderer::Ray make_shadow_ray(Random& random, const Bounds& bounds, std::uint32_t objects) {
  renderer::Ray ray;
  ray.kind = renderer::RayKind::shadow;
  ray.origin = make_place(random, bounds);
  Vec way = make_place(random, bounds) - ray.origin;
  if (random.below(4) == 0) way.x = 0;
  if (random.below(4) == 0) way.y = 0;
  if (length(way) == 0) way = {0, 0, -1};
  ray.direction = normalize(way);
  ray.reach = random.range(0.2, 1.2) * length(way);
  if (random.below(2) == 0) ray.from = static_cast<std::uint32_t>(random.below(objects));
  return ray;
}

void set(renderer::ShadowRays& rays, std::size_t k, const renderer::Ray& ray) {
  for (const auto& [lanes, axis] : {std::pair{&renderer::Vecs::x, &Vec::x},
                                    {&renderer::Vecs::y, &Vec::y},
                                    {&renderer::Vecs::z, &Vec::z}}) {
    (rays.origin.*lanes)[k] = ray.origin.*axis;
    (rays.direction.*lanes)[k] = ray.direction.*axis;
  }
  rays.reach[k] = ray.reach;
  rays.from[k] = ray.from;
}

TEST(ShadowRays, AreBlockedAsEachIsAlone) {
  std::size_t blocked = 0, free = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_mesh(make_furnished(random, static_cast<int>(seed % 7), 1), {});
    const renderer::Scene& scene = mesh.blockers;
    const auto objects = static_cast<std::uint32_t>(renderer::object_count(scene));
    for (int i = 0; i < 200; ++i) {
      renderer::ShadowRays rays{};
      std::array<bool, LANES> expected{};
      Work alone, together;
      for (std::size_t k = 0; k < LANES; ++k) {
        const auto ray = make_shadow_ray(random, scene.hierarchy.boxes[0].bounds, objects);
        set(rays, k, ray);
        rays.cast[k] = random.below(5) > 0 ? -1 : 0;
        if (!rays.cast[k]) continue;
        expected[k] = intersect(scene, ray, renderer::Traversal::nearest, alone).has_value();
        ++(expected[k] ? blocked : free);
      }
      find_blocked(scene, rays, together);
      for (std::size_t k = 0; k < LANES; ++k) ASSERT_EQ(rays.blocked[k], -expected[k]) << i;
      ASSERT_EQ(together, alone) << i;
    }
  }
  EXPECT_GT(blocked, 5000u);
  EXPECT_GT(free, 5000u);
}

// Patches are near and far, and are also seen via mirrors. All ways to divide patches are tested.
TEST(Receivers, GetWhatEachGetsAlone) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room = make_furnished(random, 3, 1 + static_cast<int>(seed % 5));
    if (seed % 4 == 0) {
      room.materials.push_back({"mirror", {0.9, 0.8, 0.7}, {}, true});
      add_quad(room, 1, {0.3, 0.3, 0.9}, {1.2, 0, 0}, {0, 1.2, 0});
    }
    const Mesh mesh = make_mesh(room, {});
    FactorParams params{.reflections = 1};
    if (seed % 3 == 0) params.halvings = 0;
    if (seed % 3 == 1) params.spread = 2;
    if (seed % 8 == 7) params.samples = 2;
    if (seed % 8 == 5) params.traversal = renderer::Traversal::exhaustive;
    const Eye eye{mesh, params};
    double lit = 0;
    for (int i = 0; i < 200; ++i) {
      const Patch& patch = pick(random, mesh.patches);
      const Glow glow =
          i % 2 ? Glow(grey(0.5))
                : Glow({random.colour(), random.colour(), random.colour(), random.colour()});
      const Sender sender(patch, glow);
      const auto count = static_cast<std::size_t>(1 + random.below(static_cast<int>(LANES)));
      Receivers receivers{};
      Work alone, together;
      Lights expected{};
      for (std::size_t k = 0; k < count; ++k) {
        receivers[k] = &pick(random, mesh.vertices);
        expected[k] = eval_light(eye, *receivers[k], sender, alone);
        lit += expected[k].r;
      }
      ASSERT_EQ(eval_lights(eye, receivers, sender, together), expected) << i;
      ASSERT_EQ(together, alone) << i;
    }
    EXPECT_GT(lit, 0);
  }
}

}  // namespace
}  // namespace radiosity::test

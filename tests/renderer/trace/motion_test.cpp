// Tests objects that move while the shutter is open. The hit of a ray must equal that in a scene at
// rest, as it is at the time of the ray.

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr Traversal TRACED_WAYS[] = {Traversal::linear, Traversal::exhaustive, Traversal::nearest};

// A random scene in which most objects move, some of them far.
Scene make_moving_scene(std::uint64_t seed, int objects, double extent) {
  Scene scene = make_random_scene(seed, objects);
  Random random{seed + 1000};
  for (int i = 0; i < objects; ++i)
    scene.moves.push_back(random.below(5) == 0 ? Vec{} : random.point(extent));
  finish(scene);
  return scene;
}

// The scene as it is at `time`, with all objects at rest there.
Scene stop(Scene scene, float time) {
  for (std::uint32_t i = 0; i < object_count(scene); ++i)
    translate(scene, i, eval_shift(scene, i, time));
  scene.moves.clear();
  finish(scene);
  return scene;
}

TEST(Motion, HitsAreThoseOfTheSceneStoppedAtTheirTime) {
  int hits = 0, inside = 0, smooth = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const double extent = seed % 3 == 0 ? 20 : seed % 3 == 1 ? 0.3 : 2;
    const Scene moving = make_moving_scene(seed, 5 + static_cast<int>(seed * 6), extent);
    Random random{seed};
    for (const float time : {0.0f, 0.375f, 0.7f, 1.0f}) {
      const Scene still = stop(moving, time);
      for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << " time " << time << " ray " << i);
        Ray ray{.origin = random.point(3), .direction = random.direction(), .influence = {}};
        ray.time = time;
        Work work;
        const auto expected = intersect(still, ray, Traversal::linear, work);
        for (const Traversal t : TRACED_WAYS) {
          const auto hit = intersect(moving, ray, t, work);
          ASSERT_EQ(hit.has_value(), expected.has_value());
          if (!hit) continue;
          ASSERT_EQ(hit->object, expected->object);
          ASSERT_EQ(hit->surface, expected->surface);
          ASSERT_EQ(hit->inside, expected->inside);
          ASSERT_NEAR(hit->distance, expected->distance, 1e-9);
          ASSERT_LT(length(hit->point - expected->point), 1e-9);
          ASSERT_LT(length(hit->normal - expected->normal), 1e-6);
          ++hits;
          inside += hit->inside;
          smooth += still.objects[hit->object].kind() == Kind::patch;
        }
      }
    }
  }
  EXPECT_GT(hits, 10000);
  EXPECT_GT(inside, 1000);
  EXPECT_GT(smooth, 1000);
}

TEST(Motion, AllTraversalsFindTheSameImage) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = make_moving_scene(seed, 30, 1.5);
    std::vector<Rendering> found;
    for (const Traversal t : TRACED_WAYS) {
      Params params = make_params(24, 18, 4, t);
      params.sampling.pixel_samples = 3;
      found.push_back(render(scene, params));
    }
    for (const Rendering& other : found) {
      EXPECT_EQ(other.samples, found[0].samples);
      EXPECT_EQ(other.rays, found[0].rays);
    }
    EXPECT_LE(found[2].work[Op::box_test], found[1].work[Op::box_test]);
  }
}

// Rays start on the surface of a moved sphere. The ray outwards must meet nothing. The ray inwards
// must meet the opposite side of the sphere, not its own origin.
TEST(Motion, ARayThatLeavesAMovingObjectDoesNotMeetItsOrigin) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Scene scene;
    scene.surfaces.push_back({});
    const Vec centre = random.point(1);
    add_sphere(scene, centre, 1);
    scene.moves = {random.point(100)};
    finish(scene);
    const auto time = static_cast<float>(random.unit());
    const Vec shift = eval_shift(scene, 0, time), way = random.direction();
    Ray ray{.origin = centre + shift + 3 * way, .direction = -way, .influence = {}};
    ray.time = time;
    Work work;
    const auto hit = intersect(scene, ray, Traversal::nearest, work);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 2, 1e-9);
    Ray out = ray, in = ray;
    out.origin = in.origin = hit->point;
    out.from = in.from = 0;
    out.direction = hit->normal;
    EXPECT_FALSE(intersect(scene, out, Traversal::nearest, work));
    const auto back = intersect(scene, in, Traversal::nearest, work);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->distance, 2, 1e-9);
    EXPECT_TRUE(back->inside);
  }
}

TEST(Motion, BoxesHoldWhatIsInThemAllTheTime) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = make_moving_scene(seed, 60, 3);
    const auto& [boxes, moves] = scene.hierarchy;
    ASSERT_EQ(moves.size(), boxes.size());
    const auto at = [&](std::size_t i, double time) {
      return Bounds{boxes[i].bounds.lo + time * moves[i].lo,
                    boxes[i].bounds.hi + time * moves[i].hi};
    };
    for (const double time : {0.0, 0.125, 0.5, 0.9, 1.0})
      for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t child = i + 1; child < boxes[i].skip; ++child)
          ASSERT_TRUE(contains(grow(at(i, time), 1e-13), at(child, time)))
              << "seed " << seed << " time " << time << " box " << i;
  }
}

TEST(Motion, AnyNumberOfThreadsAndAnyOrderGiveTheSameBits) {
  Scene scene = make_moving_scene(5, 40, 1);
  scene.view.lens = {0.2, 5};
  scene.view.from_move = {0.1, 0.2, 0};
  finish(scene);
  Params params = make_params(30, 21, 4);
  for (const double adaptive : {0.0, 0.01}) {
    params.sampling.pixel_samples = adaptive > 0 ? 30 : 7;
    params.sampling.adaptive = adaptive;
    const Rendering one = render(scene, params);
    for (const int threads : {2, 5}) {
      const Rendering many = render(scene, params, threads);
      EXPECT_EQ(many.samples, one.samples);
      EXPECT_EQ(many.counts, one.counts);
      EXPECT_EQ(many.rays, one.rays);
    }
    if (adaptive > 0) continue;
    // Traces the samples in reverse order.
    Samples backwards(30, 21);
    SampleTracer tracer(scene, params);
    for (int i = 30 * 21 * 7 - 1; i >= 0; --i)
      renderer::add(backwards.sums[static_cast<std::size_t>(i / 7)],
                    tracer.trace(i / 7 % 30, i / 7 / 30, i % 7).sums);
    EXPECT_EQ(backwards, one.samples);
  }
}

// Records every box and every object that is read.
struct Reads : Access {
  std::vector<std::uint32_t> boxes, objects;
  void box(std::uint32_t index, const Work&) override { boxes.push_back(index); }
  void object(Place place, const Work&) override { objects.push_back(place.bits); }
};

TEST(Motion, WhatIsReadIsTold) {
  const Scene scene = make_moving_scene(11, 80, 1);
  Random random{3};
  for (int i = 0; i < 200; ++i) {
    Ray ray{.origin = random.point(3), .direction = random.direction(), .influence = {}};
    ray.time = static_cast<float>(random.unit());
    Reads reads;
    Work silent, told;
    const auto expected = intersect(scene, ray, Traversal::nearest, silent);
    const auto hit = intersect(scene, ray, Traversal::nearest, told, &reads);
    ASSERT_EQ(hit.has_value(), expected.has_value());
    EXPECT_EQ(told, silent);
    EXPECT_EQ(reads.boxes.size(), told[Op::box_test]);
    EXPECT_EQ(reads.objects.size(), told[Op::sphere_test] + told[Op::polygon_test] +
                                        told[Op::patch_test] + told[Op::cone_test]);
  }
}

TEST(Motion, AViewThatBecomesImpossibleIsRefused) {
  const auto error_of = [](const Vec& from_move, const Vec& at_move) -> std::string {
    Scene scene;
    scene.view.from = {0, 0, 5};
    scene.view.from_move = from_move;
    scene.view.at_move = at_move;
    try {
      finish(scene);
    } catch (const base::BadInput& bad) {
      return bad.what();
    }
    return "";
  };
  EXPECT_EQ(error_of({0, 0, -10}, {}),
            "found a view whose 'from' and 'at' meet while the shutter is open, expected different "
            "points 'from' and 'at'");
  EXPECT_EQ(error_of({0, 0, -4.9}, {}), "");
  EXPECT_EQ(error_of({0, 8, -5}, {}).substr(0, 40), "found a view that turns along the up dir");
  EXPECT_EQ(error_of({0, 8, -10}, {}).substr(0, 40), "found a view that turns along the up dir");
  EXPECT_EQ(error_of({0, 0, -20}, {0, 0, -20}), "");
}

}  // namespace
}  // namespace renderer::test

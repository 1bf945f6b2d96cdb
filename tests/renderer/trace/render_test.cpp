// Tests the sequential renderer as a whole.

#include <gtest/gtest.h>

#include <atomic>

#include "renderer/scene/generators.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

TEST(Render, AnyNumberOfThreadsGivesTheSameBits) {
  const Scene scene = make_random_scene(21, 40);
  const Params params = make_params(50, 37, 6);
  const Rendering one = render(scene, params);
  for (const int threads : {2, 3, 100}) {
    const Rendering many = render(scene, params, threads);
    EXPECT_EQ(many.samples, one.samples) << threads << " threads";
    EXPECT_EQ(many.rays, one.rays) << threads << " threads";
    EXPECT_EQ(many.work, one.work) << threads << " threads";
  }
}

TEST(Render, EndsEarlyWithTheRowsThatAreDone) {
  const Scene scene = make_random_scene(21, 40);
  const Params params = make_params(50, 37, 6);
  const Rendering whole = render(scene, params);
  for (const int threads : {1, 3}) {
    int last = 0;
    const auto part = render(scene, params, threads, [&](int done, int rows) {
      EXPECT_EQ(rows, 37);
      last = done;
      return done < 5;
    });
    EXPECT_GE(last, 5);
    EXPECT_LT(last, 5 + threads);
    EXPECT_EQ(part.rays.primary, 50u * static_cast<unsigned>(last));
    int rows = 0;
    for (int y = 0; y < 37; ++y) {
      const auto row = [&](const Rendering& r) {
        return std::vector(r.samples.sums.begin() + 50 * y, r.samples.sums.begin() + 50 * (y + 1));
      };
      const bool is_done = row(part) != std::vector<Samples::Sums>(50);
      rows += is_done;
      EXPECT_EQ(row(part), row(is_done ? whole : part)) << y;
    }
    EXPECT_EQ(rows, last);
  }
}

TEST(Render, AreaOfInterestIsACutOut) {
  const Scene scene = make_random_scene(22, 30);
  Params params = make_params(40, 30, 4);
  const Rendering whole = render(scene, params);
  params.area = {7, 11, 20, 9};
  const Rendering part = render(scene, params);
  EXPECT_EQ(part.rays.primary, 180u);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const bool in = x >= 7 && x < 27 && y >= 11 && y < 20;
      const auto i = static_cast<std::size_t>(y * 40 + x);
      EXPECT_EQ(part.samples.sums[i], in ? whole.samples.sums[i] : Samples::Sums{});
    }
}

TEST(Render, RaysInAnyOrderGiveTheSameBits) {
  // The next ray to be traced is the newest, the oldest or a random one.
  const Scene scene = make_random_scene(23, 30);
  const Params params = make_params(12, 12, 5);
  const Samples expected = render(scene, params).samples;
  Random random{1};
  Samples found(12, 12);
  Work work;
  Children depository;
  for (int i = 0; i < 144; ++i)
    depository.push_back(make_primary(scene.view, params, i % 12, i / 12));
  while (!depository.empty()) {
    std::swap(
        depository[static_cast<std::size_t>(random.below(static_cast<int>(depository.size())))],
        depository.back());
    const Ray ray = depository.back();
    depository.pop_back();
    const auto hit = intersect(scene, ray, Traversal::exhaustive, work);
    found.add(ray.sample, eval_contribution(scene, params, ray, hit, work));
    if (hit) make_children(scene, params, ray, *hit, depository, work);
  }
  EXPECT_EQ(found, expected);
}

TEST(Render, EmptySceneIsItsBackground) {
  const Scene scene = parse("v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nb 0.25 0.5 1\n");
  const Rendering found = render(scene, make_params(3, 2, 1));
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(found.samples.get(i), (Rgb{0.25, 0.5, 1}));
}

TEST(Render, SamplePositions) {
  const Scene scene = parse("v from 0 0 1 at 0 0 0 up 0 1 0 angle 90\n");
  Params params = make_params(4, 4, 1);
  // The point where the ray meets the image plane, which extends from -1 to 1.
  const auto at = [&](SamplePosition position, int x, int y) {
    params.sample = position;
    const Vec d = make_primary(scene.view, params, x, y).direction;
    return std::array{d.x / -d.z, d.y / -d.z};
  };
  const auto expect = [&](SamplePosition position, int x, int y, double u, double v) {
    EXPECT_NEAR(at(position, x, y)[0], u, 1e-12);
    EXPECT_NEAR(at(position, x, y)[1], v, 1e-12);
  };
  expect(SamplePosition::corner, 0, 0, -1, 1);
  expect(SamplePosition::corner, 3, 2, 0.5, 0);
  expect(SamplePosition::center, 0, 0, -0.75, 0.75);
  expect(SamplePosition::lattice, 0, 0, -1, 1);
  expect(SamplePosition::lattice, 3, 3, 1, -1);
}

TEST(Render, ParamsAreChecked) {
  const auto rejects = [](auto&& change, const char* field) {
    Params params;
    change(params);
    try {
      check(params);
      ADD_FAILURE() << field << " accepted";
    } catch (const base::BadInput& bad) {
      EXPECT_EQ(std::string(bad.what()).substr(0, std::string(field).size()), field);
    }
  };
  rejects([](Params& p) { p.width = 0; }, "size");
  rejects([](Params& p) { p.height = -3; }, "size");
  rejects([](Params& p) { p.width = 65537; }, "size");
  rejects([](Params& p) { p.width = p.height = 65536; }, "size");
  rejects([](Params& p) { p.limits.depth = 0; }, "depth");
  rejects([](Params& p) { p.limits.depth = 1001; }, "depth");
  rejects([](Params& p) { p.limits.min_influence = std::nan(""); }, "min_influence");
  rejects([](Params& p) { p.ambient = -1; }, "ambient");
  rejects([](Params& p) { p.area = {90, 0, 11, 1}; }, "area");
  rejects([](Params& p) { p.area = {0, 0, 5, 0}; }, "area");
  rejects([](Params& p) { p.area = {2000000000, 0, 2000000000, 1}; }, "area");
  EXPECT_THROW(render(make_spheres(1), Params{}, 0), base::BadInput);
}

// A row has 40 pixels; the rendering ends within it.
TEST(Render, EndsAtAPixel) {
  const Scene scene = make_spheres(9);
  const Params params = make_params(40, 2, 3);
  const auto whole = render(scene, params);
  for (const int threads : {1, 3}) {
    std::atomic<int> asked = 0;
    const auto part = render(scene, params, threads, {}, [&] { return ++asked > 50; });
    int traced = 0;
    for (std::size_t i = 0; i < whole.samples.sums.size(); ++i) {
      traced += part.samples.sums[i] == whole.samples.sums[i];
      EXPECT_TRUE(part.samples.sums[i] == Samples::Sums{} ||
                  part.samples.sums[i] == whole.samples.sums[i]);
    }
    EXPECT_LE(traced, 50);
    EXPECT_GT(traced, 40);
  }
}

TEST(Render, ProgressIsToldAndMayStopIt) {
  const Scene scene = make_spheres(1);
  int calls = 0;
  render(scene, make_params(5, 9, 1), 2, [&](int done, int rows) {
    EXPECT_EQ(done, ++calls);
    EXPECT_EQ(rows, 9);
    return true;
  });
  EXPECT_EQ(calls, 9);
  const auto stop = [](int, int) -> bool { throw std::runtime_error("enough"); };
  EXPECT_THROW(render(scene, make_params(5, 9, 1), 3, stop), std::runtime_error);
}

}  // namespace
}  // namespace renderer::test

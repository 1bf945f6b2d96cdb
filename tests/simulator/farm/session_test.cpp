// The growing picture as the user sees it, and the effects of the user's orders.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/simulator/farm/farm_support.hpp"
#include "topologies/make/generators.hpp"

namespace farm {
namespace {

Result run(const Params& params, const char* topology = "tree:3") {
  return run_farm({machine::load_model("t805-25"), topologies::make_topology(topology)},
                  make_glass_scene(), params);
}

Limits first_level(int min_cell) {
  Limits limits;
  limits.min_cell = min_cell;
  limits.depth_reflected = limits.depth_transmitted = 1;
  return limits;
}

Params staged_params() {
  Params params = small_params();
  params.image.ambient = 0.5;
  params.stages = {first_level(8), first_level(2), first_level(1), Limits{}};
  return params;
}

double mean_level(const std::vector<std::uint8_t>& rgb8) {
  double sum = 0;
  for (const auto level : rgb8) sum += level;
  return sum / static_cast<double>(rgb8.size());
}

std::ptrdiff_t black_pixels(const std::vector<std::uint8_t>& rgb8) {
  std::ptrdiff_t n = 0;
  for (std::size_t i = 0; i < rgb8.size(); i += 3)
    n += rgb8[i] == 0 && rgb8[i + 1] == 0 && rgb8[i + 2] == 0;
  return n;
}

// The first rays come from the top of the scene, which has two mirrors. The last rays hit nothing.
// At the end of the phase, there is therefore no child ray that would make the coordination ask the
// database again. New limits must nevertheless take effect at once.
TEST(Session, RaysThatNewLimitsAdmitAreAskedForAtOnce) {
  const auto scene = renderer::parse_scene(
      "v\nfrom 0 -4 0\nat 0 0 0\nup 0 0 1\nangle 40\nhither 0.01\nresolution 24 24\n"
      "b 0.2 0.4 0.7\nf 1 1 1 0.1 0.9 20 0 1\ns -0.4 0 1 0.4\ns 0.4 0 1 0.4\n",
      "mirrors");
  // Returns the total time and the time of the interactive phase, in seconds.
  const auto run_with = [&](std::vector<Order> script) {
    return test::isolated_numbers([&]() -> std::vector<double> {
      Params params = small_params();
      params.order = CellOrder::sequential;
      params.max_cell = 1;
      params.stages = {first_level(1)};
      params.script = std::move(script);
      const auto r = run_farm({machine::load_model("t805-25"), topologies::make_topology("tree:3")},
                              scene, params);
      return {r.time_s, r.interactive_s};
    });
  };
  const auto alone = run_with({});
  ASSERT_GT(alone[0] - alone[1], 0.01);
  for (int i = 0; i < 40; ++i) {
    const double at_s = alone[1] - 0.00002 * i;
    const auto times = run_with({{{at_s}, {Limits{}}}});
    EXPECT_NEAR(times[1], times[0], 0.001) << at_s;
  }
}

// The result must be the sequential image for any order of cells, any kind of cells, any weights,
// and any orders of the user.
TEST(Session, EndsWithTheImage) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    run_isolated([&] {
      std::mt19937_64 random(seed);
      Params params = small_params();
      params.max_cell = 1 << random() % 5;
      params.order = static_cast<CellOrder>(random() % 4);
      params.cells = static_cast<CellLight>(random() % 3);
      params.seed = seed;
      if (random() % 3 == 0) params.image.area = {5, 3, 13, 10};
      if (random() % 2 == 0)
        params.weights = {static_cast<double>(random() % 3), 1, static_cast<double>(random() % 2)};
      params.stages = {random_limits(random), random_limits(random)};
      double at_s = 0;
      for (auto n = random() % 5; n-- > 0;) {
        at_s += 0.05 * static_cast<double>(random() % 8);
        Order order{{at_s}, random_limits(random)};
        if (random() % 4 == 0) order.what = NonInteractive{};
        if (random() % 4 == 0) order.what = Interactive{};
        params.script.push_back(order);
      }
      const auto result = run(params, seed % 2 == 0 ? "tree:1" : "tree:5");
      const auto expected = render(make_glass_scene(), params.image, 1).samples;
      EXPECT_EQ(result.samples, expected);
      EXPECT_EQ(result.rgb8, make_rgb8(expected));
    });
  }
}

// With several samples per pixel, a lens, area lights and rough surfaces, the result must also be
// the sequential image.
TEST(Session, EndsWithTheImageOfSeveralSamples) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    run_isolated([&] {
      std::mt19937_64 random(seed);
      Params params = small_params();
      params.image.sampling = test::random_sampling(random);
      params.image.sample = static_cast<renderer::SamplePosition>(random() % 3);
      params.max_cell = 1 << random() % 5;
      params.order = static_cast<CellOrder>(random() % 4);
      params.cells = static_cast<CellLight>(random() % 3);
      if (random() % 3 == 0) params.image.area = {5, 3, 13, 10};
      if (is_adaptive(params.image.sampling)) params.image.area = {5, 3, 6, 4};
      params.stages = {random_limits(random), random_limits(random)};
      if (random() % 2 == 0) params.script = {{{0.1}, random_limits(random)}};
      const auto scene = test::make_soft_scene();
      const auto result = run_farm(
          {machine::load_model("t805-25"), topologies::make_topology("tree:3")}, scene, params);
      const auto expected = render(scene, params.image, 1);
      EXPECT_EQ(result.samples, expected.samples);
      EXPECT_EQ(result.rgb8, make_rgb8(expected.samples));
      EXPECT_EQ(result.rays, expected.rays);
    });
  }
}

// In a saved picture (key image), a pixel may be black only if it is black in the final picture.
// The mean level of each key image must be near that of the last one.
TEST(Session, KeyImagesAreWholePictures) {
  for (const auto light : {CellLight::constant, CellLight::smooth}) {
    const std::string told = isolated([light] {
      Params params = staged_params();
      params.cells = light;
      const auto result = run(params);
      std::string text = fmt::format("{}", result.key_images.size());
      const double last = mean_level(result.key_images.back().rgb8);
      for (const auto& key : result.key_images)
        text += fmt::format(" {} {} {}", key.name, black_pixels(key.rgb8),
                            std::abs(mean_level(key.rgb8) / last - 1) < 0.1);
      return text;
    });
    EXPECT_EQ(told, "3 stage1 0 true stage2 0 true stage3 0 true");
  }
}

TEST(Session, PointsAreDark) {
  const std::string told = isolated([] {
    Params params = staged_params();
    params.cells = CellLight::point;
    const auto result = run(params);
    const auto pixels = static_cast<std::ptrdiff_t>(result.rgb8.size() / 3);
    return fmt::format("{} {} {}", pixels - black_pixels(result.key_images[0].rgb8),
                       pixels - black_pixels(result.key_images[1].rgb8),
                       mean_level(result.key_images[0].rgb8) < 0.05 * mean_level(result.rgb8));
  });
  // The first stage has 3 x 3 cells with sides of 8 pixels, the second 12 x 9 cells of 2 pixels.
  EXPECT_EQ(told, "9 108 true");
}

// All rays within the first limits are traced long before the next order comes. The farm must wait
// for this order.
TEST(Session, TheNullModeWaitsForTheNextOrder) {
  const std::string told = isolated([] {
    Params params = staged_params();
    params.stages = {first_level(8)};
    params.script = {{{5}, {first_level(4)}}, {{9}, {Limits{}}}};
    const auto result = run(params);
    std::string names;
    for (const auto& key : result.key_images) names += key.name + " ";
    return fmt::format("{}{} {} {} {}", names, result.time_s > 9, result.interactive_s > 9,
                       result.notes.size(), result.order_to_pixel_s.value() < 0.05);
  });
  EXPECT_EQ(told, "order1 order2 true true 0 true");
}

TEST(Session, TheUserComesBackFromTheNonInteractivePhase) {
  const std::string told = isolated([] {
    Params params = staged_params();
    params.stages = {first_level(8)};
    params.script = {{{0.02}, {NonInteractive{}}},
                     {{0.04}, {NonInteractive{}}},
                     {{0.06}, {Interactive{}}},
                     {{0.08}, {Interactive{}}},
                     {{3}, {NonInteractive{}}}};
    const auto result = run(params);
    return fmt::format("{} {} {:.1f}", result.notes.at(0), result.notes.at(1),
                       result.interactive_s);
  });
  EXPECT_EQ(told,
            "order 2 had no effect: the interactive phase was already over order 4 had no effect: "
            "the interactive phase was not over 3.0");
}

TEST(Session, AnAbortEndsWithThePictureAsItIs) {
  const std::string told = isolated([] {
    Params params = small_params();
    params.script = {{{0.1}, {Save{"first"}}}, {{0.2}, {Abort{}}}, {{60}, {Limits{}}}};
    const auto result = run(params);
    std::string names;
    for (const auto& key : result.key_images) names += key.name + " ";
    return fmt::format("{}{} {} {}", names, result.is_aborted, result.time_s < 0.3,
                       result.notes.at(1));
  });
  EXPECT_TRUE(
      told.starts_with("first order2 true true order 3 had no effect: the program had ended"))
      << told;
}

// The preview must appear before the first ray, and rays must paint over it.
TEST(Session, APreviewComesFirst) {
  const std::string told = isolated([] {
    Params params = small_params();
    params.preview = renderer::PreviewStep::flat;
    const auto result = run(params);
    const auto& preview = result.key_images.at(0);
    return fmt::format(
        "{} {} {}", preview.name, preview.at.value > 0,
        black_pixels(preview.rgb8) < 24 * 18 / 10 && result.rgb8 == make_rgb8(result.samples));
  });
  EXPECT_EQ(told, "preview true true");
}

// Orders that arrive together with an abort, but after it, must have no effect.
TEST(Session, NothingIsOrderedAfterAnAbort) {
  const std::string told = isolated([] {
    Params params = small_params();
    params.script = {{{0.2}, {Abort{}}}, {{0.2}, {Interactive{}}}, {{0.2}, {first_level(4)}}};
    const auto result = run(params);
    return fmt::format("{} {} {} {}", result.time_s < 0.3, result.notes.at(1), result.notes.at(2),
                       result.notes.size());
  });
  EXPECT_EQ(told,
            "true order 2 had no effect: the run was already aborted order 3 had no effect: the "
            "run was already aborted 3");
}

// Each change of limits reclassifies all rays. The pause must grow with the number of rays, here
// about fourfold.
TEST(Session, ReorderingTakesItsTime) {
  const auto pause_s = [](int factor) {
    return test::isolated_numbers([&] {
      Params params = small_params();
      params.stages = {first_level(8), Limits{}};
      params.image.width *= factor;
      params.image.height *= factor;
      return std::vector{run(params).reorder_pause_s.value()};
    })[0];
  };
  const double ratio = pause_s(2) / pause_s(1);
  EXPECT_GT(ratio, 3.5);
  EXPECT_LT(ratio, 5);
}

// Recording snapshots must not change the run, and the last snapshot must be the final image.
TEST(Session, LookingCostsNothing) {
  const double blind_s =
      test::isolated_numbers([] { return std::vector{run(small_params()).time_s}; })[0];
  const std::string told = isolated([blind_s] {
    Params params = small_params();
    params.snapshot_times = {.at_s = {0.1, 0.25}, .every_s = 0.2, .growth = 10};
    const auto seen = run(params);
    std::string text =
        fmt::format("{} {} {}", blind_s == seen.time_s, seen.rgb8 == seen.growth.back().rgb8,
                    seen.growth.size() >= 10 && seen.growth.size() <= 21);
    for (std::size_t i = 0; i < 4; ++i) text += fmt::format(" {:.2f}", seen.pictures.at(i).at_s);
    return text;
  });
  EXPECT_EQ(told, "true true true 0.10 0.20 0.25 0.40");
}

TEST(Session, SmoothCellsAreTheDisplaysWork) {
  const auto busy_s = [](CellLight light) {
    return test::isolated_numbers([light] {
      Params params = staged_params();
      params.cells = light;
      const auto result = run(params, "tree:7");
      return std::vector{find_role(result.use, Role::display)->busy_s};
    })[0];
  };
  EXPECT_GT(busy_s(CellLight::smooth), 2 * busy_s(CellLight::constant));
}

}  // namespace
}  // namespace farm

// The growing picture as the user sees it, and the effects of the user's orders.
#include <gtest/gtest.h>

#include <algorithm>

#include "simulator/iirra/measured.hpp"
#include "tests/simulator/iirra/iirra_support.hpp"

namespace iirra {
namespace {

Limits coarse(int min_cell) {
  Limits limits;
  limits.min_cell = min_cell;
  limits.depth_reflected = limits.depth_transmitted = 1;
  return limits;
}

std::string names(const Result& result) {
  std::string all;
  for (const auto& key : result.key_images) all += key.name + " ";
  return all;
}

std::string notes(const Result& result) {
  std::string all;
  for (const auto& note : result.notes) all += note + "; ";
  return all;
}

// With 16 processors and 800 spheres, an area selected by the user must change within 0.1 s.
TEST(IirraSession, AnOrderReachesTheScreenWithinATenthOfASecond) {
  for (const double at_s : {0.3, 1.0}) {
    const double waited_s = test::isolated_numbers([&] {
      Params params;
      params.image.width = params.image.height = 64;
      params.stages = {coarse(8), Limits{}};
      Limits pointed;
      pointed.area = {20, 30, 16, 12};
      params.script = {{{at_s}, {pointed}}};
      const auto result =
          run(params, topologies::make_topology("mesh:4x4"), renderer::make_spheres(800));
      return std::vector{result.order_to_pixel_s.value_or(-1)};
    })[0];
    EXPECT_GT(waited_s, 0);
    EXPECT_LE(waited_s, 0.1);
  }
}

TEST(IirraSession, KeyImagesHaveNames) {
  for (const bool is_polled : {true, false}) {
    SCOPED_TRACE(is_polled);
    const std::string told = isolated([&] {
      Params params = small_params();
      params.is_polled = is_polled;
      params.stages = {coarse(8), coarse(4), Limits{}};
      return names(run(params));
    });
    EXPECT_EQ(told, "stage1 stage2 ");
  }
}

// All steps within the first limits are done long before the next order. The run must wait for this
// order.
TEST(IirraSession, TheNullModeWaitsForTheNextOrder) {
  for (const bool is_polled : {true, false}) {
    SCOPED_TRACE(is_polled);
    run_isolated([&] {
      Params params = small_params();
      params.is_polled = is_polled;
      params.stages = {coarse(8)};
      params.script = {{{3}, {coarse(4)}}, {{4}, {ray_tracing::Save{"kept"}}}, {{6}, {Limits{}}}};
      const auto result = run(params);
      EXPECT_EQ(names(result), "stage1 order1 kept order3 ");
      EXPECT_GT(result.time_s, 6);
      EXPECT_GT(result.interactive_s, 6);
      EXPECT_EQ(notes(result), "");
      EXPECT_LT(result.order_to_pixel_s.value(), 0.1);
      EXPECT_NE(result.key_images[0].rgb8, result.rgb8);
      EXPECT_EQ(result.rgb8, make_rgb8(render(make_glass_scene(), params.image).samples));
    });
  }
}

TEST(IirraSession, TheUserComesBackFromTheNonInteractivePhase) {
  run_isolated([] {
    Params params = small_params();
    params.stages = {coarse(8)};
    params.script = {{{0.02}, {ray_tracing::NonInteractive{}}},
                     {{0.04}, {ray_tracing::NonInteractive{}}},
                     {{0.06}, {ray_tracing::Interactive{}}},
                     {{0.08}, {ray_tracing::Interactive{}}},
                     {{3}, {ray_tracing::NonInteractive{}}}};
    const auto result = run(params);
    EXPECT_EQ(notes(result),
              "order 2 had no effect: the interactive phase was already over; order 4 had no "
              "effect: the interactive phase was not over; ");
    EXPECT_NEAR(result.interactive_s, 2.96, 0.03);
    EXPECT_EQ(result.rgb8, make_rgb8(render(make_glass_scene(), params.image).samples));
  });
}

// Columns about stages, [data] and double nodes must exist only if the run has these.
TEST(IirraSession, MeasuresTheColumnsThatItDeclares) {
  run_isolated([] {
    Params params = small_params();
    params.stages = {coarse(8), Limits{}};
    const Measured measured(run(params), {});
    std::vector<std::string> declared;
    for (const auto& column : make_columns()) declared.push_back(column.name);
    for (const auto& [name, cell] : base::make_row(make_columns(), measured)) {
      std::string family = name;
      if (const auto digit = family.find("stage1"); digit == 0) family.replace(5, 1, "{}");
      EXPECT_NE(std::ranges::find(declared, family), declared.end()) << name;
    }
    const auto& losses = measured.losses;
    const double of_image =
        measured.run.kernels_s / (measured.run.workers * measured.run.time_s) - losses.repeated;
    EXPECT_NEAR(
        of_image + losses.idle + losses.data + losses.repeated + losses.routing + losses.managing,
        1, 1e-6);
  });
}

// The stage is complete when the user aborts the run. The run must end without starting new work.
TEST(IirraSession, AnAbortWhileNothingIsLeftToDoEndsTheRun) {
  run_isolated([] {
    Params params = small_params();
    params.stages = {coarse(8)};
    params.script = {{{3}, {ray_tracing::Abort{}}}, {{20}, {ray_tracing::Save{"late"}}}};
    const auto result = run(params);
    EXPECT_TRUE(result.is_aborted);
    EXPECT_LT(result.time_s, 3.5);
    EXPECT_NEAR(result.interactive_s, result.time_s, 1e-9);
    EXPECT_NE(result.rgb8, make_rgb8(render(make_glass_scene(), params.image).samples));
  });
}

// Limits arrive while pictures, which workers send unasked, are on their way. The run must still
// complete the image; no worker may wait for ever.
TEST(IirraSession, OrdersWhilePicturesAreSentLoseNothing) {
  for (int order = 0; order < 12; ++order)
    run_isolated([&] {
      SCOPED_TRACE(order);
      Params params = small_params();
      params.is_polled = false;
      params.balance = order % 2 == 0 ? BalanceMethod::none : BalanceMethod::active;
      params.stages = {coarse(8)};
      const double at_s = 0.03 + 0.011 * order;
      params.script = {{{at_s}, {coarse(4)}}, {{at_s + 0.004}, {Limits{}}}};
      const auto result = run(params);
      EXPECT_EQ(result.rgb8, make_rgb8(render(make_glass_scene(), params.image).samples));
    });
}

TEST(IirraSession, AnAbortEndsWithThePictureAsItIs) {
  for (const bool is_polled : {true, false}) {
    SCOPED_TRACE(is_polled);
    run_isolated([&] {
      Params params = small_params();
      params.is_polled = is_polled;
      params.script = {{{0.1}, {ray_tracing::Save{"first"}}},
                       {{0.2}, {ray_tracing::Abort{}}},
                       {{60}, {Limits{}}}};
      const auto result = run(params);
      EXPECT_TRUE(result.is_aborted);
      EXPECT_EQ(names(result), "first ");
      EXPECT_GE(result.time_s, 0.2);
      EXPECT_LT(result.time_s, 0.4);
      EXPECT_LE(result.last_task_s, result.ended_s);
      EXPECT_EQ(notes(result), "order 3 had no effect: the run was already aborted; ");
      const auto finished = std::ranges::count(result.finished, true);
      EXPECT_GT(finished, 0);
      EXPECT_LT(finished, 24 * 18);
    });
  }
}

std::int64_t cell_of(const Result& result, const std::string& name) {
  const Measured measured(result, {});
  for (const auto& column : make_columns())
    if (column.name == name) return std::get<std::int64_t>(column.get(measured).at(0));
  throw std::runtime_error("no column " + name);
}

// In an incomplete run, samples of unfinished pixels must not be counted as computed twice.
TEST(IirraSession, OnlyAWholePictureTellsOfDoubleSamples) {
  run_isolated([] {
    Params params = small_params();
    params.balance = BalanceMethod::none;
    const auto whole = run(params);
    const auto inside = whole.counts.samples - whole.counts.samples_outside;
    EXPECT_EQ(cell_of(whole, "samples_double"), static_cast<std::int64_t>(inside) - 24 * 18);
    EXPECT_GT(cell_of(whole, "rays_double"), 0);
  });
  run_isolated([] {
    Params params = small_params();
    params.script = {{{0.1}, {ray_tracing::Abort{}}}};
    const auto aborted = run(params);
    EXPECT_EQ(cell_of(aborted, "samples_double"), 0);
    EXPECT_EQ(cell_of(aborted, "rays_double"), 0);
  });
}

TEST(IirraSession, StagesThatWereNotNeededAreNoted) {
  const auto told = [](const std::vector<Limits>& stages) {
    return isolated([&] {
      Params params = small_params();
      params.stages = stages;
      return notes(run(params));
    });
  };
  EXPECT_EQ(told({Limits{}, coarse(8)}), "the picture was complete in stage 1; ");
  EXPECT_EQ(told({coarse(8), Limits{}, coarse(4)}), "the picture was complete in stage 2; ");
  EXPECT_EQ(told({coarse(8), Limits{}}), "");
}

// Orders that arrive when the picture is complete must have no effect and must be noted.
TEST(IirraSession, OrdersAfterTheEndAreNoted) {
  run_isolated([] {
    Params params = small_params();
    params.script = {{{100}, {coarse(4)}}, {{101}, {ray_tracing::Save{"late"}}}};
    const auto result = run(params);
    EXPECT_EQ(notes(result),
              "order 1 had no effect: the picture was complete; "
              "order 2 had no effect: the picture was complete; ");
    EXPECT_LT(result.time_s, 100);
    EXPECT_EQ(names(result), "");
  });
}

// Recording snapshots must not change the run, and the last snapshot must be the final image.
TEST(IirraSession, LookingCostsNothing) {
  const double blind_s =
      test::isolated_numbers([] { return std::vector{run(small_params()).time_s}; })[0];
  run_isolated([blind_s] {
    Params params = small_params();
    params.snapshot_times = {.at_s = {0.1, 0.25}, .every_s = 0.2, .growth = 10};
    const auto seen = run(params);
    EXPECT_EQ(blind_s, seen.time_s);
    ASSERT_GE(seen.growth.size(), 10u);
    EXPECT_EQ(seen.rgb8, seen.growth.back().rgb8);
    EXPECT_EQ(seen.pictures.at(0).at_s, 0.1);
    EXPECT_EQ(seen.pictures.at(2).at_s, 0.25);
  });
}

// While the limits admit only the user's area of interest, no other pixel may be computed.
TEST(IirraSession, TheAreaOfInterestIsAllThatIsComputed) {
  run_isolated([] {
    Params params = small_params();
    Limits pointed;
    pointed.area = {8, 8, 8, 8};
    params.stages = {pointed};
    params.script = {{{5}, {ray_tracing::Save{"kept"}}}, {{6}, {Limits{}}}};
    const auto result = run(params);
    ASSERT_EQ(names(result), "stage1 kept order2 ");
    EXPECT_EQ(result.key_images[0].rgb8, result.key_images[1].rgb8);
    const auto& key = result.key_images[0].rgb8;
    std::size_t lit = 0;
    for (std::size_t y = 0; y < 18; ++y)
      for (std::size_t x = 0; x < 24; ++x) {
        const auto at = 3 * (24 * y + x);
        const bool is_inside = x >= 8 && x < 16 && y >= 8 && y < 16;
        const bool is_lit = key[at] + key[at + 1] + key[at + 2] > 0;
        lit += is_lit;
        if (is_inside)
          for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(key[at + c], result.rgb8[at + c]);
        else
          EXPECT_FALSE(is_lit) << x << " " << y;
      }
    EXPECT_GT(lit, 32u);
  });
}

// The drain is the time after the last task was taken. It must be positive, because that task and
// its picture still have to be finished.
TEST(Columns, TheDrainIsTheEndOfTheTime) {
  run_isolated([] {
    const Measured measured(run(small_params()), {});
    std::map<std::string, double> row;
    for (const auto& [name, cell] : base::make_row(make_columns(), measured))
      if (const auto* number = std::get_if<double>(&cell)) row[name] = *number;
    EXPECT_GT(row.at("drain_s"), 0);
    EXPECT_LT(row.at("drain_s"), row.at("time_s") / 2);
  });
}

}  // namespace
}  // namespace iirra

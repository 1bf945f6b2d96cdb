// Machines drawn from what the numbers of a model may be.
#include "experiments/laboratory/uncertain/draw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/laboratory/setup/setup.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {
namespace {

const machine::Entry& entry_of(const machine::Model& model, const std::string& key) {
  return *std::ranges::find(model.entries, key, &machine::Entry::key);
}

TEST(Draw, EveryMachineHasAnotherSlice) {
  for (const std::size_t machines : {2u, 7u, 64u})
    for (const std::string entry : {"a.b", "a.c"}) {
      std::set<std::size_t> slices;
      for (std::size_t i = 0; i < machines; ++i) {
        const double quantile = draw_quantiles(5, entry, machines)[i];
        EXPECT_GT(quantile, 0);
        EXPECT_LT(quantile, 1);
        slices.insert(static_cast<std::size_t>(quantile * static_cast<double>(machines)));
      }
      EXPECT_EQ(slices.size(), machines);
    }
}

TEST(Draw, DependsOnSeedAndEntryAlone) {
  EXPECT_EQ(draw_quantiles(5, "a.b", 64)[3], draw_quantiles(5, "a.b", 64)[3]);
  EXPECT_NE(draw_quantiles(5, "a.b", 64)[3], draw_quantiles(6, "a.b", 64)[3]);
  EXPECT_NE(draw_quantiles(5, "a.b", 64)[3], draw_quantiles(5, "a.c", 64)[3]);
}

TEST(Draw, SharesAreEvenInTheirLogarithm) {
  const machine::Range share{0.8, 1.25, true, ""}, number{10, 30, false, ""};
  EXPECT_NEAR(find_in(share, 0.5), 1, 1e-12);
  EXPECT_NEAR(find_in(share, 0), 0.8, 1e-12);
  EXPECT_EQ(find_in(number, 0.25), 15);
}

// At the middle of all ranges, in shares that are even about 1, the model is as it stands.
TEST(Draw, SetsEveryEntryThatHasARangeButThoseThatAreSet) {
  const Entries set = {{"scheduler.return_to_low", "20"}};
  const auto drawn = draw_machine("t805-25", set, [](const std::string&) { return 0.9; });
  const auto before = machine::load_model("t805-25");
  const auto after = machine::override_model("t805-25", drawn, "test");
  EXPECT_EQ(entry_of(after, "scheduler.return_to_low").value, 20);
  EXPECT_NEAR(entry_of(after, "disk.rate").value, 3e5 + 0.9 * 5e5, 1e-6);
  for (const auto& entry : before.entries)
    EXPECT_EQ(std::ranges::count(drawn, entry.key, &Entries::value_type::first),
              entry.range ? 1 : 0)
        << entry.key;
  // A formula stays one, of what others are.
  EXPECT_NE(entry_of(after, "operation.box_test").formula.find("instruction.add"),
            std::string::npos);
}

// Whatever the operations cost, what a calibrated cell fixes stays.
TEST(Draw, WhatIsCalibratedHoldsItsCell) {
  const auto before = machine::load_model("t805-25");
  for (std::size_t machine = 0; machine < 16; ++machine) {
    const auto drawn = draw_machine("t805-25", {}, [&](const std::string& entry) {
      return entry.starts_with("scale.") ? 0.5 : draw_quantiles(9, entry, 16)[machine];
    });
    const auto after = machine::override_model("t805-25", drawn, "test");
    for (const auto* key : {"scale.intersection", "scale.central"}) {
      const auto& holds = entry_of(before, key).holds;
      ASSERT_NE(holds, "");
      const auto& range = *entry_of(before, key).range;
      EXPECT_NEAR(eval(after, holds, "") / eval(before, holds, ""), find_in(range, 0.5), 1e-9)
          << key << ", machine " << machine;
    }
  }
}

TEST(Draw, SpreadsTheFileOverTheMachines) {
  const auto file = read_experiment(
      "[network]\nworkers = 2\n[sweep]\nobjects = [10, 20]\n[uncertain]\nmachines = 3\n", "e.toml",
      "", {});
  const auto all = spread(file);
  ASSERT_EQ(all.points.size(), 8u);
  EXPECT_EQ(name_of(all.points[1]), "objects = 20");
  EXPECT_EQ(name_of(all.points[5]), "objects = 20, machine = 2");
  std::set<std::string> models;
  for (const auto& point : all.points) models.insert(model_key(point.experiment.model));
  EXPECT_EQ(models.size(), 4u);
  EXPECT_EQ(model_key(all.points[2].experiment.model), model_key(all.points[3].experiment.model));
}

}  // namespace
}  // namespace laboratory

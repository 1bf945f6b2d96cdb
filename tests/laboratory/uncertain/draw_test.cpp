// Machines drawn at random from the ranges of a model's entries.
#include "experiments/laboratory/uncertain/draw.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "simulator/machine/model.hpp"
#include "tests/support/files.hpp"

namespace laboratory {
namespace {

const machine::Entry& entry_of(const machine::Model& model, std::string_view key) {
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

// Every entry with a range is drawn once, except entries that the experiment sets.
TEST(Draw, SetsEveryEntryThatHasARangeButThoseThatAreSet) {
  const machine::Overrides set = {{"scheduler.return_to_low", 20.0}};
  const auto drawn = draw_machine("t805-25", set, [](const std::string&) { return 0.9; });
  const auto before = machine::load_model("t805-25");
  const auto after = machine::override_model("t805-25", drawn, "test");
  EXPECT_EQ(entry_of(after, "scheduler.return_to_low").value, 20);
  EXPECT_NEAR(entry_of(after, "disk.rate").value, 3e5 + 0.9 * 5e5, 1e-6);
  for (const auto& entry : before.entries)
    EXPECT_EQ(std::ranges::count(drawn, entry.key, &machine::Overrides::value_type::first),
              entry.range ? 1 : 0)
        << entry.key;
  // A drawn entry whose value is a formula still depends on the other entries.
  EXPECT_NE(entry_of(after, "operation.box_test").formula.find("instruction.add"),
            std::string::npos);
}

// Draws costs of operations, and then fits the calibrated entry. Whatever costs are drawn, the fit
// keeps the value of the entry's formula `holds`. (The comparison divides out the random share that
// is drawn for the entry itself.)
TEST(Draw, WhatIsCalibratedHoldsItsCell) {
  const auto before = machine::load_model("t805-25");
  for (std::size_t machine = 0; machine < 16; ++machine) {
    auto drawn = draw_machine("t805-25", {}, [&](const std::string& entry) {
      return draw_quantiles(9, entry, 16)[machine];
    });
    for (const auto* key : {"scale.intersection", "scale.central", "scale.router"}) {
      const auto& entry = entry_of(before, key);
      ASSERT_NE(entry.holds, "");
      const double drawn_share = find_in(*entry.range, draw_quantiles(9, key, 16)[machine]);
      const auto after = machine::override_model("t805-25", drawn, "test");
      const double fitted = entry_of(after, key).value / drawn_share;
      auto refitted = drawn;
      std::ranges::find(refitted, key, &machine::Overrides::value_type::first)->second = fitted;
      const auto cell = machine::override_model("t805-25", refitted, "test");
      EXPECT_NEAR(eval(cell, entry.holds, "") / eval(before, entry.holds, ""), 1, 1e-9)
          << key << ", machine " << machine;
    }
  }
}

// The draw is refused if no value of the entry gives its formula `holds` the previous value, or if
// the formula is not linear in the entry.
TEST(Draw, WhatCannotBeHeldIsRefused) {
  const auto draw = [](const std::string& holds) {
    const test::TemporaryFolder folder;
    const auto path = folder.path / "a.toml";
    std::ofstream(path) << R"(name = "a"
base = "t805-25"
[scale]
router = { value = 6, unit = "1", provenance = "calibrated", source = "x", low = "95 %", high = "105 %", why = "y", holds = ")"
                        << holds << "\" }\n";
    return draw_machine(path.string(), {}, [](const std::string&) { return 0.9; });
  };
  EXPECT_THROW(draw("operation.procedure"), base::BadInput);
  EXPECT_THROW(draw("scale.router * scale.router * operation.procedure"), base::BadInput);
  EXPECT_THROW(draw("0.001 * scale.router + operation.procedure"), base::BadInput);
  EXPECT_NO_THROW(draw("scale.router * operation.procedure + operation.element"));
}

TEST(Draw, SpreadsTheFileOverTheMachines) {
  const auto file = load_experiment(
      {"[network]\nworkers = 2\n[sweep]\nobjects = [10, 20]\n[uncertain]\nmachines = 3\n", "e.toml",
       ""},
      {});
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

// The choice of the result columns that are shown first.
#include "experiments/laboratory/points/view.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/text.hpp"

namespace laboratory {
namespace {

// Two points with the axis `refine`, three parameters that are constant, and results. The result
// `speedup` is empty, `ended` is constant, and the other results are shown if the width permits.
const Table OF_RADIOSITY = {.columns = {"refine", "processors", "mean", "sends", "time_s", "rays",
                                        "speedup", "useful", "ended"},
                            .axes = 1,
                            .rows = {{2, 4, "simpson", "mean", 1.5, 10, {}, 0.5, "done"},
                                     {3, 4, "simpson", "mean", 2.5, 20, {}, 0.6, "done"}}};

ExperimentFile read(const std::string& more) {
  return load_experiment(
      {"[program]\nname = \"radiosity\"\nscene = \"w.room\"\n[sweep]\nrefine = [2, 3]\n" + more,
       "e.toml", ""},
      {});
}

using Texts = std::vector<std::string>;

TEST(TableView, AxesThenWhatIsAskedThenOtherResults) {
  const auto file = read(
      "[let]\nwhole = \"useful * 2\"\n[[check]]\nname = \"c\"\nof = "
      "\"whole\"\nat_most = 3\n");
  const auto view = choose_view(file, OF_RADIOSITY);
  EXPECT_EQ(view.columns, (Texts{"refine", "useful", "time_s", "rays"}));
  EXPECT_EQ(view.least, 2u);
  const std::vector<std::pair<std::string, std::string>> constants = {
      {"processors", "4"}, {"mean", "simpson"}, {"sends", "mean"}};
  EXPECT_EQ(view.constants, constants);
}

// A check may refer to a column through a chain of definitions of any length.
TEST(TableView, WhatIsAskedByWayOfManyDefinitions) {
  auto file = read("[let]\nd0 = \"useful\"\n[[check]]\nname = \"c\"\nof = \"d0\"\nat_most = 3\n");
  constexpr int LENGTH = 50'000;
  file.definitions.clear();
  for (int i = 0; i < LENGTH; ++i)
    file.definitions.push_back({fmt::format("d{}", i), fmt::format("d{0} + d{0}", i + 1), ""});
  file.definitions.push_back({fmt::format("d{}", LENGTH), "useful", ""});
  EXPECT_EQ(choose_view(file, OF_RADIOSITY).columns, (Texts{"refine", "useful", "time_s", "rays"}));
}

TEST(TableView, WhatVariesIsNoConstant) {
  auto table = OF_RADIOSITY;
  table.rows[1][1] = 9;
  table.rows[1].back() = "deadlock";
  const auto view = choose_view(read(""), table);
  EXPECT_EQ(view.columns, (Texts{"refine", "processors", "ended", "time_s", "rays", "useful"}));
}

TEST(TableView, NamedColumns) {
  const auto named =
      choose_view(read("[report]\ncolumns = [\"rays\", \"tame_s\"]\n"), OF_RADIOSITY);
  EXPECT_EQ(named.columns, (Texts{"refine", "rays"}));
  EXPECT_EQ(named.unknown, Texts{"no column \"tame_s\", the nearest is \"time_s\""});
  EXPECT_EQ(choose_view(read("[report]\ncolumns = [\"all\"]\n"), OF_RADIOSITY).columns,
            OF_RADIOSITY.columns);
}

// At any width, the first columns are shown and no text is cut. If more columns fit, no line is
// wider than the width.
TEST(TableView, FitsTheWidth) {
  const auto view = choose_view(read(""), OF_RADIOSITY);
  Texts before;
  for (std::size_t width = 20; width < 90; ++width) {
    const auto columns = fit_columns(OF_RADIOSITY, view, width);
    ASSERT_GE(columns.size(), view.least);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), columns.begin())) << width;
    before = columns;
    if (columns.size() == view.least) continue;
    for (const auto& line : base::split(to_text(OF_RADIOSITY, view, width), '\n'))
      EXPECT_TRUE(line.size() <= width || line.find("results.csv") != line.npos) << line;
  }
  EXPECT_EQ(before, view.columns);
  EXPECT_NE(to_text(OF_RADIOSITY, view, 12).find("5 more columns are in results.csv"),
            std::string::npos)
      << to_text(OF_RADIOSITY, view, 12);
}

}  // namespace
}  // namespace laboratory

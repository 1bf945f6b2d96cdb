// Points beyond saturation, in plots and in sentences.
#include "experiments/laboratory/report/saturation.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/plot/plot_data.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

const programs::SaturationColumns COLUMNS{"full", "load", "limit", "bound by the busiest link"};

// A sweep over the load for one pattern. `marks` has a letter for each load 0.1, 0.2, ... and each
// of `seeds`: 1 if the point is beyond saturation, 0 if not, and - if it did not complete.
void add_sweep(Table& table, const std::string& pattern, const std::string& marks,
               std::size_t seeds = 1) {
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto step = static_cast<double>(1 + i / seeds);
    auto& row = table.rows.emplace_back();
    row = {pattern, step / 10, static_cast<std::int64_t>(i % seeds), step, Value(), 0.5};
    if (marks[i] != '-') row[4] = std::int64_t{marks[i] == '1'};
  }
}

Table make_table() {
  return {.columns = {"pattern", "load", "seed", "time_s", "full", "limit"}, .axes = 3, .rows = {}};
}

Plot plot_time(const Table& table) { return make_plots(table, Texts{"time_s"}).at(0); }

TEST(ExperimentsSaturation, EachCurveMarksItsPoints) {
  auto table = make_table();
  add_sweep(table, "neighbour", "0000");
  add_sweep(table, "transpose", "0011");
  add_sweep(table, "shuffle", "0001");
  auto plot = plot_time(table);
  mark_saturated(plot, table, COLUMNS);
  ASSERT_EQ(plot.series.size(), 5u) << "no series without points";
  EXPECT_EQ(plot.series[3].kind, SeriesKind::saturated);
  EXPECT_EQ(plot.series[3].of, 1u);
  EXPECT_EQ(plot.series[3].y, (std::vector<double>{3, 4}));
  EXPECT_EQ(plot.series[4].of, 2u);
  EXPECT_EQ(plot.series[4].x, std::vector<double>{0.4});
  EXPECT_EQ(plot.series[3].name, "beyond saturation");
  EXPECT_EQ(plot.series[4].name, "") << "one entry of the legend stands for all curves";
  auto unmarked = plot_time(table);
  mark_saturated(unmarked, table, {"other", "load", "", ""});
  EXPECT_EQ(unmarked.series.size(), 3u) << "the table lacks the column";
}

TEST(ExperimentsSaturation, HalfOfTheSeedsDecide) {
  auto table = make_table();
  add_sweep(table, "shuffle", "000110111", 3);
  auto plot = plot_time(table);
  mark_saturated(plot, table, COLUMNS);
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.series[1].x, (std::vector<double>{0.2, 0.3}));
  EXPECT_EQ(tell_saturation(table, COLUMNS),
            Texts{"Saturated from load 0.2 on; the bound by the busiest link is 0.5."});
}

TEST(ExperimentsSaturation, SentencesStateWhereItBegins) {
  auto table = make_table();
  add_sweep(table, "neighbour", "0000");
  add_sweep(table, "transpose", "0011");
  add_sweep(table, "shuffle", "0101");
  add_sweep(table, "uniform", "010-");
  add_sweep(table, "file", "----");
  const std::string bound = "; the bound by the busiest link is 0.5.";
  EXPECT_EQ(tell_saturation(table, COLUMNS),
            (Texts{"pattern = neighbour: not saturated up to load 0.4" + bound,
                   "pattern = transpose: saturated from load 0.3 on" + bound,
                   "pattern = shuffle: saturated from load 0.4 on, and at 0.2" + bound,
                   "pattern = uniform: saturated at load 0.2, but not at 0.3" + bound}));
  EXPECT_EQ(tell_saturation(table, {"full", "load", "", ""})[0],
            "pattern = neighbour: not saturated up to load 0.4.");
  EXPECT_TRUE(tell_saturation(table, {"full", "time_s", "", ""}).empty()) << "time_s is no axis";
  auto fixed = make_table();
  add_sweep(fixed, "neighbour", "0");
  add_sweep(fixed, "transpose", "1");
  EXPECT_TRUE(tell_saturation(fixed, COLUMNS).empty()) << "a single load";
}

TEST(ExperimentsSaturation, ManySeriesHaveFewSentences) {
  auto table = make_table();
  for (int i = 0; i < 15; ++i) add_sweep(table, "p" + std::to_string(i), "01");
  const auto sentences = tell_saturation(table, COLUMNS);
  ASSERT_EQ(sentences.size(), 13u);
  EXPECT_EQ(sentences[12], "Saturation of 3 more series: see the column full.");
}

TEST(ExperimentsSaturation, SymbolsAreHollow) {
  auto table = make_table();
  for (int i = 0; i < 7; ++i) add_sweep(table, "p" + std::to_string(i), "01");
  auto plot = plot_time(table);
  mark_saturated(plot, table, COLUMNS);
  const auto script = make_gnuplot_script(plot);
  const auto has = [&](const std::string& text) { return contains(script, text); };
  // the square of the second curve
  EXPECT_TRUE(has("$cover8 with points linecolor rgb '#ffffff' linewidth 2 pointtype 5 "));
  EXPECT_TRUE(has("$data8 with points linecolor rgb '#D55E00' linewidth 2 pointtype 4 ")) << script;
  // the seventh curve has a cross, which a disc replaces
  EXPECT_TRUE(has("$data13 with points linecolor rgb '#000000' linewidth 2 pointtype 6 "));
  EXPECT_TRUE(
      has("keyentry with points linecolor rgb '#404040' linewidth 2 pointtype 6 pointsize "
          "1 title \"beyond saturation\""));
  const auto data = nlohmann::json::parse(make_plot_data(plot, table));
  EXPECT_EQ(data["series"][8]["kind"], "saturated");
  EXPECT_EQ(data["series"][8]["of"], 1);
  EXPECT_EQ(data["series"][8]["symbol"], 1);
}

// In a ring of four processors, a third of the messages take two links, all in the same sense. A
// link in this sense carries 1/3 + 2/3 messages for each message of a sender: the bound is 1.
TEST(ExperimentsSaturation, RunsOfTrafficStateIt) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml")
      << "[network]\ntopology = \"ring:4\"\n[sweep]\nload = [0.01, 4]\n";
  for (const std::string program : {"traffic", "router_load"}) {
    const auto run =
        tlab(folder.path, {"run", "e.toml", "-o", program, "--set", "program.name=" + program,
                           "--set", "program.window_s=0.02"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string sentence = "Saturated from load 4 on; the bound by the busiest link is 1.";
    EXPECT_TRUE(contains(run.out, sentence)) << run.out;
    EXPECT_TRUE(contains(read_file(folder.path / program / "report.html"), sentence));
    EXPECT_TRUE(contains(read_file(folder.path / program / "report.html"),
                         "\"name\":\"beyond saturation\",\"kind\":\"saturated\""));
  }
}

}  // namespace
}  // namespace laboratory

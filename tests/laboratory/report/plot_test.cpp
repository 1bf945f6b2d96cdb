#include "experiments/laboratory/plot/plot.hpp"

#include <cmath>
#include <regex>
#include <set>

#include "experiments/laboratory/plot/gnuplot.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "simulator/programs/programs.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {
namespace {

using Names = std::vector<std::string>;

Value integer(int value) { return std::int64_t{value}; }

// A sweep whose workers are not in ascending order, with time_s = objects / workers.
Table make_sweep(const Names& topologies, const std::vector<int>& objects,
                 const std::vector<int>& workers) {
  Table table{
      .columns = {"topology", "workers", "objects", "rays", "time_s", "speedup", "efficiency"},
      .axes = 3,
      .rows = {}};
  for (const auto& topology : topologies)
    for (const int w : workers)
      for (const int o : objects)
        table.rows.push_back(
            {topology, integer(w), integer(o), integer(10000), double(o) / w, double(w), 1.0});
  return table;
}

Names plot_names(const std::vector<Plot>& plots) {
  Names names;
  for (const auto& plot : plots) names.push_back(plot.name);
  return names;
}

Names series_names(const Plot& plot) {
  Names names;
  for (const auto& series : plot.series) names.push_back(series.name);
  return names;
}

// The default plots of the farm.
std::vector<Plot> make_usual_plots(const Table& table) {
  return make_plots(table, programs::find_program("farm")->shows.plots);
}

TEST(ExperimentsPlots, OnePlotPerColumnOverWorkers) {
  const auto plots = make_usual_plots(make_sweep({"tree"}, {200, 3200}, {4, 1, 2}));
  ASSERT_EQ(plot_names(plots), (Names{"time_s", "speedup", "efficiency"}));
  EXPECT_EQ(plots[0].title, "Time: tree");
  EXPECT_EQ(plots[0].x_label, "workers");
  EXPECT_EQ(plots[0].y_label, "time [s]");
  EXPECT_FALSE(plots[0].ideal_line);
  ASSERT_EQ(series_names(plots[0]), (Names{"200 objects", "3200 objects"}));
  EXPECT_EQ(plots[0].series[1].x, (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(plots[0].series[1].y, (std::vector<double>{3200, 1600, 800}));
  EXPECT_TRUE(plots[1].ideal_line);
  EXPECT_EQ(plots[2].y_min, 0);
  EXPECT_EQ(plots[2].y_max, 1.05);
}

TEST(ExperimentsPlots, SeriesAreNamedByEveryAxisThatVaries) {
  const auto plots = make_usual_plots(make_sweep({"tree", "mesh"}, {1, 200}, {1, 2}));
  EXPECT_EQ(series_names(plots[0]),
            (Names{"tree, 1 object", "tree, 200 objects", "mesh, 1 object", "mesh, 200 objects"}));
  EXPECT_EQ(plots[0].title, "Time");
}

TEST(ExperimentsPlots, WithoutWorkersTheFirstNumericAxisThatVaries) {
  const auto plots = make_usual_plots(make_sweep({"tree", "mesh"}, {200, 800, 3200}, {7}));
  ASSERT_EQ(plots.size(), 3u);
  EXPECT_EQ(plots[1].x_label, "objects");
  EXPECT_EQ(plots[1].title, "Speed-up: 7 workers");
  EXPECT_FALSE(plots[1].ideal_line) << "y = x means nothing over objects";
  EXPECT_TRUE(plots[1].log_x);
  EXPECT_EQ(series_names(plots[1]), (Names{"tree", "mesh"}));
  EXPECT_TRUE(make_usual_plots(make_sweep({"tree", "mesh"}, {200}, {7})).empty());
  EXPECT_TRUE(make_usual_plots(Table{}).empty());
}

TEST(ExperimentsPlots, EmptyCellsAreNoPoints) {
  auto table = make_sweep({"tree"}, {200}, {1, 2, 3});
  table.rows[1][4] = {};
  table.rows[2][4] = NAN;
  for (auto& row : table.rows) row[5] = {};
  const auto plots = make_usual_plots(table);
  ASSERT_EQ(plot_names(plots), (Names{"time_s", "efficiency"}));
  EXPECT_EQ(plots[0].series[0].x, (std::vector<double>{1}));
  table.rows[0][6] = 1.5;
  EXPECT_DOUBLE_EQ(*make_usual_plots(table)[1].y_max, 1.05 * 1.5);
}

TEST(ExperimentsPlots, OtherAxesAreNamedReadably) {
  Table table{.columns = {"workers", "link_rate_mbit_s", "depth", "order", "time_s"},
              .axes = 4,
              .rows = {}};
  for (const int w : {1, 2})
    for (const double rate : {5.0, 20.0})
      for (const int depth : {3, 15})
        for (const char* order : {"false", "true"})
          table.rows.push_back({integer(w), rate, integer(depth), order, 1.0});
  const auto names = series_names(make_usual_plots(table).at(0));
  EXPECT_EQ(names.front(), "link rate 5 Mbit/s, depth 3, order false");
  EXPECT_EQ(names.back(), "link rate 20 Mbit/s, depth 15, order true");
}

Plot awkward_plot() {
  const std::string text = "it's \"100%\" a_b^c $(rm -rf x) `touch pwned` {@} <b>&\\n\nµ";
  return {.name = "awkward 1",
          .title = text,
          .x_label = text,
          .y_label = text,
          .series =
              {{.name = text, .x = {1, 2, 3}, .y = {1, NAN, 2.5}},
               {.name = text + ", thesis", .x = {1, 2}, .y = {1, 2}, .kind = SeriesKind::reference},
               {.name = "empty", .x = {}, .y = {}}},
          .ideal_line = true,
          .y_min = {},
          .y_max = {}};
}

TEST(ExperimentsDrawing, QuotedTextExpandsNothing) {
  EXPECT_EQ(quote_for_gnuplot("a'b\n\"$(x)`y`\\@z"), R"("a'b \"$(x)\140y\140\\\100z")");
}

TEST(ExperimentsDrawing, TitlesMayBeginWithAnyQuote) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  Plot plot;
  plot.name = "quotes";
  plot.title = "'Ideal' speed-up";
  plot.x_label = "''workers''";
  plot.y_label = "\"speed-up\"";
  plot.series = {{.name = "'", .x = {1, 2}, .y = {1, 2}}};
  draw_plot(plot, folder.path);
  const auto svg = read_file(folder.path / "quotes.svg");
  for (const auto& text : {plot.title, plot.x_label, plot.y_label, plot.series[0].name})
    EXPECT_NE(svg.find("<text>" + text + "</text>"), std::string::npos) << text;
}

TEST(ExperimentsDrawing, EndsOfCdataInTitlesAreNoneInTheSvg) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  Plot plot = awkward_plot();
  plot.title = plot.x_label = "a ]]> b";
  plot.series[0].name = "c ]]> d";
  const TemporaryFolder folder;
  draw_plot(plot, folder.path);
  std::string svg = read_file(folder.path / (plot.name + ".svg"));
  EXPECT_NE(svg.find("a ]]&gt; b"), svg.npos);
  for (std::size_t begin; (begin = svg.find("<![CDATA[")) != svg.npos;)
    svg.erase(begin, svg.find("]]>", begin) + 3 - begin);
  EXPECT_EQ(svg.find("]]>"), svg.npos);
}

TEST(ExperimentsDrawing, ReferencesHaveTheColourOfTheirCurve) {
  Plot plot;
  plot.series = {{.name = "200 objects", .x = {1}, .y = {1}},
                 {.name = "3200 objects", .x = {1}, .y = {1}},
                 {.name = "thesis", .x = {1}, .y = {1}, .kind = SeriesKind::reference, .of = 1}};
  const auto script = make_gnuplot_script(plot);
  EXPECT_NE(script.find("$data1 with linespoints linecolor rgb '#D55E00'"), std::string::npos);
  EXPECT_NE(script.find("$data2 with points linecolor rgb '#D55E00'"), std::string::npos);
}

TEST(ExperimentsDrawing, LinesDifferWithoutTheirColours) {
  Plot plot;
  for (int i = 0; i < 16; ++i)
    plot.series.push_back({.name = "s" + std::to_string(i), .x = {1}, .y = {1}});
  const auto script = make_gnuplot_script(plot);
  std::set<std::string> looks;
  const std::regex look("dashtype (\\S+) pointtype (\\d+)");
  for (std::sregex_iterator found(script.begin(), script.end(), look), end; found != end; ++found)
    looks.insert(found->str());
  EXPECT_EQ(looks.size(), 16u);
}

TEST(ExperimentsDrawing, LawsAndMarksBelongToTheirCurve) {
  Plot plot;
  plot.series = {{.name = "a (s = 0.1)", .x = {1, 2}, .y = {1, 2}},
                 {.name = "b (s = 0.2)", .x = {1, 2}, .y = {1, 2}},
                 {.name = "", .x = {1}, .y = {1}, .kind = SeriesKind::law, .of = 1},
                 {.name = "top", .x = {2}, .y = {2}, .kind = SeriesKind::mark, .of = 1}};
  const auto script = make_gnuplot_script(plot);
  EXPECT_NE(script.find("$data2 with lines linecolor rgb '#D55E00' linewidth 1 "),
            std::string::npos);
  EXPECT_NE(script.find("$data3 with points linecolor rgb '#000000'"), std::string::npos);
}

TEST(ExperimentsDrawing, ScalesOfPowersOfTwoHaveThatBase) {
  Plot plot;
  plot.series = {{.name = "", .x = {1, 2, 256}, .y = {1, 2, 100}}};
  plot.log_x = plot.log_y = plot.ideal_line = true;
  auto script = make_gnuplot_script(plot);
  EXPECT_NE(script.find("set logscale x 2\nset logscale y 2\n"), std::string::npos) << script;
  EXPECT_NE(script.find("set xtics ('1' 1, '2' 2, '256' 256)"), std::string::npos) << script;
  plot.ideal_line = false;
  script = make_gnuplot_script(plot);
  EXPECT_NE(script.find("set logscale y 10\n"), std::string::npos) << script;
  EXPECT_NE(script.find("set ytics ('1' 1, '2' 2, '5' 5, '10' 10, "), std::string::npos) << script;
  EXPECT_TRUE(wants_log_x("workers", {1, 2, 256}));
  EXPECT_FALSE(wants_log_x("workers", {1, 2, 16}));
  EXPECT_TRUE(wants_log_x("objects", {1, 2, 16}));
}

TEST(ExperimentsDrawing, WhatCannotBeDrawnIsNamed) {
  const auto message = [](const Plot& plot) {
    return message_of<std::invalid_argument>([&] { draw_plot(plot, "/tmp"); });
  };
  auto plot = awkward_plot();
  plot.series = {{.name = "s", .x = {1, 2}, .y = {NAN, NAN}}};
  EXPECT_EQ(message(plot), "plot awkward 1: no points to draw");
  plot.series[0].y = {1};
  EXPECT_EQ(message(plot), "plot awkward 1: the series \"s\" has 2 x but 1 y");
  plot.name = "../up";
  EXPECT_TRUE(message(plot).starts_with("plot \"../up\": its name is no file stem"));
}

TEST(ExperimentsDrawing, MakesTheSameSvgAndPngEveryTime) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder, again;
  draw_plot(awkward_plot(), folder.path);
  draw_plot(awkward_plot(), again.path);
  ASSERT_EQ(folder.names(), (Names{"awkward 1.png", "awkward 1.svg"}));
  const auto svg = read_file(folder.path / "awkward 1.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find("it's \"100%\" a_b^c $(rm -rf x) `touch pwned` {@} &lt;b>&amp;\\n µ"),
            std::string::npos);
  EXPECT_TRUE(read_file(folder.path / "awkward 1.png").starts_with("\x89PNG\r\n\x1a\n"));
  for (const auto& name : folder.names())
    EXPECT_EQ(read_file(folder.path / name), read_file(again.path / name)) << name;
  EXPECT_FALSE(std::filesystem::exists("pwned"));
}

TEST(ExperimentsDrawing, DrawsEveryKindOfAxis) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  for (const bool log_x : {false, true})
    for (const bool log_y : {false, true})
      for (const std::vector<double>& x : {std::vector<double>{5}, {0.5, 2, 1000}, {0, 1, 64}}) {
        Plot plot;
        plot.name = "plot";
        plot.series = {{.name = "", .x = x, .y = x}};
        plot.ideal_line = true;
        plot.log_x = log_x;
        plot.log_y = log_y;
        plot.y_min = 0;
        EXPECT_NO_THROW(draw_plot(plot, folder.path)) << log_x << log_y << x.size();
      }
}

// All lines of the legend are inside the drawing, however long the names are.
TEST(ExperimentsDrawing, TheKeyFitsIntoTheDrawing) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  const std::regex text(R"re(translate\([-0-9.]+,([-0-9.]+)\)[^>]*>\s*<text>N)re");
  for (const std::size_t length : {1u, 5u, 12u, 20u, 27u, 40u, 70u})
    for (const std::size_t count : {1u, 3u, 8u}) {
      Plot plot;
      plot.name = "key";
      for (std::size_t i = 0; i < count; ++i)
        plot.series.push_back(
            {.name = "N" + std::string(length - 1, 'w'), .x = {1, 2}, .y = {double(i), 3}});
      draw_plot(plot, folder.path);
      const auto svg = read_file(folder.path / "key.svg");
      std::size_t found = 0;
      for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at, ++found) {
        EXPECT_LT(std::stod((*at)[1]), choose_height(plot)) << length << " " << count;
      }
      EXPECT_EQ(found, count) << length;
    }
}

TEST(ExperimentsDrawing, ASecondPanelShowsDifferences) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  Plot plot;
  plot.name = "panels";
  plot.series = {{.name = "s", .x = {1, 2, 4}, .y = {1, 2, 4}}};
  const int height = choose_height(plot);
  plot.differences = {{.name = "", .x = {1, 2, 4}, .y = {-1, 0, 12.5}, .of = 0}};
  plot.difference_label = "difference [%]";
  EXPECT_GT(choose_height(plot), height);
  draw_plot(plot, folder.path);
  EXPECT_NE(read_file(folder.path / "panels.svg").find("difference [%]"), std::string::npos);
  plot.differences[0].y = {0, 0, 0};
  EXPECT_NO_THROW(draw_plots({plot, plot}, folder.path));
}

// The distance between ticks is 1, 2 or 5 times a power of ten, and at most five ticks fit into the
// range.
TEST(ExperimentsDrawing, DifferencesHaveRoundSteps) {
  Plot plot;
  plot.series = {{.name = "s", .x = {1, 2}, .y = {1, 2}}};
  for (const auto& [most, step] : {std::pair(12.5, "5"), {4.0, "1"}, {8.0, "2"}, {80.0, "20"}}) {
    plot.differences = {{.name = "", .x = {1, 2}, .y = {0, most}, .of = 0}};
    const auto script = make_gnuplot_script(plot);
    EXPECT_NE(script.find(fmt::format("]\nset ytics {}\n", step)), std::string::npos)
        << most << "\n"
        << script;
  }
}

TEST(ExperimentsDrawing, SaysThatGnuplotIsMissing) {
  const TemporaryFolder folder;
  const char* path = getenv("PATH");
  const std::string old = path ? path : "";
  setenv("PATH", folder.path.c_str(), 1);
  const auto message =
      message_of<std::runtime_error>([&] { draw_plot(awkward_plot(), folder.path); });
  setenv("PATH", old.c_str(), 1);
  EXPECT_EQ(message,
            "plot awkward 1: drawing needs the program gnuplot, which was not found: install "
            "gnuplot-nox");
  EXPECT_TRUE(folder.names().empty());
}

TEST(ExperimentsDrawing, PassesOnWhatGnuplotSays) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const auto message =
      message_of<std::runtime_error>([] { run_gnuplot("plot nonsense(x)\n", "p"); });
  EXPECT_TRUE(message.starts_with("plot p: gnuplot failed")) << message;
  EXPECT_NE(message.find("nonsense"), std::string::npos) << message;
}

}  // namespace
}  // namespace laboratory

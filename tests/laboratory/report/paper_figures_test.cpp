// Figures for papers, SI prefixes, legends, and labels that fit.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/plot/gnuplot.hpp"
#include "experiments/laboratory/plot/plot_layout.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "experiments/laboratory/plot/si_prefix.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

Plot make_plot_of(const std::vector<double>& x, const std::vector<double>& y) {
  Plot plot;
  plot.name = "p";
  plot.x_label = "length [bytes]";
  plot.y_label = "time [s]";
  plot.series = {{.name = "s", .x = x, .y = y}};
  return plot;
}

TEST(SiPrefix, SuitsTheLargestNumberOfEachAxis) {
  for (const auto& [y, label, value] : {std::tuple(0.0045, "time [ms]", 4.5),
                                        {2e-6, "time [µs]", 2.0},
                                        {2e-9, "time [ns]", 2.0},
                                        {1.0, "time [s]", 1.0},
                                        {0.9, "time [ms]", 900.0},
                                        {5e4, "time [s]", 5e4}}) {
    auto plot = make_plot_of({3000, 1}, {y / 2, y});
    plot.series[0].low = plot.series[0].high = plot.series[0].y;
    plot.y_max = y;
    choose_prefixes(plot);
    EXPECT_EQ(plot.y_label, label);
    EXPECT_DOUBLE_EQ(plot.series[0].y[1], value);
    EXPECT_DOUBLE_EQ(plot.series[0].high[1], value);
    EXPECT_DOUBLE_EQ(*plot.y_max, value);
    EXPECT_EQ(plot.x_label, "length [kB]");
    EXPECT_EQ(plot.series[0].x, (std::vector<double>{3, 0.001}));
  }
}

TEST(SiPrefix, LeavesAxesThatWouldBecomeHarderToRead) {
  auto plot = make_plot_of({1024, 4096}, {1e-6, 0.5});
  plot.log_y = true;
  choose_prefixes(plot);
  EXPECT_EQ(plot.x_label, "length [bytes]") << "powers of two";
  EXPECT_EQ(plot.y_label, "time [s]") << "more than three decades";
  plot = make_plot_of({1, 3000}, {1e-3, 2e-3});
  plot.ideal_line = true;
  choose_prefixes(plot);
  EXPECT_EQ(plot.x_label + plot.y_label, "length [bytes]time [s]");
}

TEST(Legend, NamesTheAxesOnceAndTheValuesOfEachCurve) {
  Table table{.columns = {"topology", "workers", "objects", "time_s"}, .axes = 3, .rows = {}};
  for (const auto* topology : {"tree", "ring"})
    for (const std::int64_t workers : {1, 2})
      for (const std::int64_t objects : {50, 200})
        table.rows.push_back({topology, workers, objects, 1.0});
  const auto plot = make_plots(table, std::vector<std::string>{"time_s"}).at(0);
  EXPECT_EQ(plot.legend_title, "topology, objects");
  EXPECT_EQ(plot.series[1].name, "tree, 200 objects");
  EXPECT_EQ(plot.series[1].key(), "tree, 200");
  const auto script = make_gnuplot_script(plot);
  EXPECT_NE(script.find("title \"topology, objects:\""), script.npos);
  EXPECT_NE(script.find("title \"tree, 200\""), script.npos);
}

// If axes are coupled, the names of curves contain only one of them.
TEST(Legend, OmitsAxesThatOthersDetermine) {
  Table table{.columns = {"workers", "height", "objects", "time_s"}, .axes = 3, .rows = {}};
  for (const std::int64_t workers : {1, 2})
    for (const std::int64_t objects : {50, 200})
      table.rows.push_back({workers, 16 * workers, objects, 1.0});
  EXPECT_EQ(choose_series_axes(table, all_rows(table), {}), (std::vector<std::size_t>{0, 2}));
}

TEST(PlotLayout, BreaksAndShortensLabels) {
  EXPECT_EQ(shorten_middle("abcdefghij", 10), "abcdefghij");
  EXPECT_EQ(shorten_middle("abcdefghij", 5), "ab…ij");
  EXPECT_EQ(shorten_middle("µµµµµµ", 3), "µ…µ");
  using Lines = std::vector<std::string>;
  EXPECT_EQ(break_label("time [s]", 8), (Lines{"time [s]"}));
  EXPECT_EQ(break_label("mean time per ray [ms]", 14), (Lines{"mean time per", "ray [ms]"}));
  for (const auto& line : break_label(std::string(200, 'x'), 30)) EXPECT_LE(width_of(line), 30u);
}

TEST(PlotLayout, TicksDoNotOverlap) {
  const PlotSize size = choose_size({.width_mm = 85});
  std::vector<double> ticks;
  for (double tick = 1; tick < 3e6; tick *= 4) ticks.push_back(tick);
  const auto labels = label_log_ticks(ticks, 0.8, 3e6, 180, size);
  ASSERT_EQ(labels.size(), ticks.size());
  EXPECT_EQ(labels[0].text, "1");
  double end = -1e9;
  std::size_t shown = 0;
  for (const auto& [at, text] : labels) {
    if (text.empty()) continue;
    ++shown;
    const double middle = 180 * std::log(at / 0.8) / std::log(3e6 / 0.8);
    EXPECT_GT(middle - size.width_of(text.size()) / 2, end);
    end = middle + size.width_of(text.size()) / 2;
  }
  EXPECT_LT(shown, ticks.size());
  EXPECT_GT(shown, 3u);
}

TEST(PaperFigure, OfAPlotHasItsSizeAndFontAndNoBackground) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  auto plot = make_plot_of({1, 2, 3}, {1, 2, 3});
  plot.title = "a title";
  plot.figure = {.width_mm = 178, .font = "DejaVu Serif", .font_pt = 9};
  const auto svg = draw_figure(plot);
  EXPECT_NE(svg.find("<svg width=\"178mm\""), svg.npos);
  EXPECT_NE(svg.find("viewBox=\"0 0 504.5669 "), svg.npos) << svg.substr(0, 200);
  EXPECT_NE(svg.find("font-family=\"DejaVu Serif\" font-size=\"9.00\""), svg.npos);
  EXPECT_EQ(svg.find("fill=\"#ffffff\""), svg.npos);
  EXPECT_EQ(svg.find("a title"), svg.npos);
  const auto pdf = svg_to_pdf(svg, "p");
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 504.5669"), pdf.npos);
  EXPECT_NE(pdf.find("+DejaVuSerif"), pdf.npos);
  EXPECT_EQ(pdf, svg_to_pdf(draw_figure(plot), "p"));
}

struct FigureRun {
  TemporaryFolder folder;
  Outcome outcome;
  explicit FigureRun(const std::string& text) {
    std::ofstream(folder.path / "e.toml") << text;
    outcome = tlab(folder.path, {"run", "e.toml", "-o", "out"});
  }
  std::string read(const std::string& name) const { return read_file(folder.path / "out" / name); }
  bool has(const std::string& name) const {
    return std::filesystem::exists(folder.path / "out" / name);
  }
};

const std::string SMALL =
    "[image]\nwidth = 6\nheight = 4\n[scene]\nobjects = 9\n[sweep]\nworkers = [1, 2, 4]\n";

TEST(PaperFigure, IsDrawnForPlotsAndNetworksOfAReport) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const FigureRun run(SMALL + "[report]\nnetworks = \"largest\"\nwidth = \"column\"\n");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  for (const auto* name : {"speedup", "time_s", "network-workers-4"})
    for (const auto* ending : {".svg", ".pdf"})
      EXPECT_TRUE(run.has("figures/" + std::string(name) + ending)) << name;
  EXPECT_TRUE(contains(run.read("figures/speedup.pdf"), "/MediaBox [ 0 0 240.94488"));
  EXPECT_TRUE(contains(run.read("figures/network-workers-4.pdf"), "/MediaBox [ 0 0 240.94488"));
  const auto again =
      tlab(run.folder.path, {"report", "out", "--width", "page", "--font-size", "10"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(contains(run.read("figures/speedup.svg"), "width=\"178mm\""));
  EXPECT_TRUE(contains(run.read("figures/speedup.svg"), "font-size=\"10.00\""));
}

TEST(PaperFigure, IsDrawnForOnePlotAndRefusesBadKeys) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const auto plots = [](const std::string& key) {
    return SMALL + "[[plot]]\nname = \"a\"\nx = \"workers\"\ny = \"time_s\"\n" + key +
           "[[plot]]\nname = \"b\"\nx = \"workers\"\ny = \"speedup\"\n";
  };
  const FigureRun run(plots("width = \"column\"\n"));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_TRUE(run.has("figures/a.pdf"));
  EXPECT_FALSE(run.has("figures/b.pdf"));
  for (const auto& [key, message] :
       {std::pair("width = \"wide\"\n", "expected one of column, page, none"),
        {"font = \"Times, serif\"\n", "the name of one font family, without commas"},
        {"font_size = 3\n", "4"}}) {
    const FigureRun bad(plots(key));
    EXPECT_EQ(bad.outcome.exit_code, 2) << key;
    EXPECT_TRUE(contains(bad.outcome.err, message)) << bad.outcome.err;
  }
}

TEST(PaperFigure, OfATopologyAndATimelineIsAPdf) {
  const FigureRun run(SMALL + "[report]\nwidth = \"column\"\n");
  const auto topology =
      tlab(run.folder.path, {"topology", "ring:5", "-o", "r.pdf", "--width", "column"});
  EXPECT_EQ(topology.exit_code, 0) << topology.err;
  EXPECT_TRUE(contains(read_file(run.folder.path / "r.pdf"), "/MediaBox [ 0 0 240.94488"));
  const auto timeline = tlab(run.folder.path, {"run", "e.toml", "-o", "one", "--set",
                                               "sweep.workers=[2]", "--timeline", "t.pdf"});
  EXPECT_EQ(timeline.exit_code, 0) << timeline.err;
  EXPECT_TRUE(contains(read_file(run.folder.path / "t.pdf"), "/MediaBox [ 0 0 240.94488"));
  EXPECT_EQ(tlab(run.folder.path, {"topology", "ring:5", "--width", "column"}).exit_code, 2);
}

// The programs share a plot of the time, while "objects" is a setting of both.
TEST(Report, OfSeveralProgramsShowsAResult) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const FigureRun run(
      "[image]\nwidth = 16\nheight = 16\n[scene]\nobjects = 9\n[sweep]\nworkers = [1, 2]\n"
      "\"program.name\" = [\"farm\", \"iirra\"]\n");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_TRUE(run.has("plots/time_s.svg"));
  EXPECT_FALSE(run.has("plots/objects.svg"));
  EXPECT_FALSE(contains(run.read("report.html"), "same objects"));
}

}  // namespace
}  // namespace laboratory

// Plots in the format of the page's script.
#include "experiments/laboratory/plot/plot_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/plot/plot_script.hpp"
#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

using nlohmann::json;

// Two curves of speed-up: one by Amdahl's law with the serial fraction 0.1, one by Gustafson's with
// 0.2.
Plot make_example() {
  Plot plot;
  plot.name = "p";
  plot.title = "T <script>";
  plot.x_label = "workers";
  plot.y_label = "speed-up";
  for (const int n : {1, 2, 4, 8}) {
    add_point(plot.series, "a", plot.series.empty() ? 0 : plot.series[0].x.size(), n,
              amdahl_speedup(0.1, n));
    add_point(plot.series, "g", 4, n, gustafson_speedup(0.2, n));
  }
  plot.series.push_back({.name = "", .x = {2}, .y = {1.5}, .kind = SeriesKind::mark, .of = 1});
  plot.ideal_line = plot.log_x = true;
  plot.y_min = 0;
  return plot;
}

const Table TABLE{.columns = {"x"}, .axes = 1, .rows = {}, .points = {7, 7, 8, 9, 9}};

TEST(ExperimentsPlotData, EveryPointWithItsPointOfTheSweep) {
  const auto plot = make_example();
  const auto data = json::parse(make_plot_data(plot, TABLE));
  EXPECT_EQ(data["title"], "T <script>");
  EXPECT_EQ(data["x"], (json{{"label", "workers"}, {"log", true}}));
  EXPECT_EQ(data["y"], (json{{"label", "speed-up"}, {"log", false}, {"min", 0}}));
  EXPECT_EQ(data["ideal"], true);
  ASSERT_EQ(data["series"].size(), 3u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& point = data["series"][0]["points"][i];
    EXPECT_EQ(point[0].get<double>(), plot.series[0].x[i]);
    EXPECT_EQ(point[1].get<double>(), plot.series[0].y[i]) << "every digit";
    EXPECT_EQ(point[2].get<std::size_t>(), TABLE.points[i]);
  }
  EXPECT_FALSE(data.contains("difference"));
  EXPECT_FALSE(data.contains("laws")) << "this plot is not told to be a speed-up";
  EXPECT_EQ(make_plot_data(plot, TABLE), make_plot_data(plot, TABLE));
}

TEST(ExperimentsPlotData, LooksAreGnuplots) {
  const auto data = json::parse(make_plot_data(make_example(), TABLE));
  const auto& mark = data["series"][2];
  EXPECT_EQ(mark["kind"], "mark");
  EXPECT_EQ(mark["of"], 1);
  EXPECT_EQ(mark["colour"], look_of(1).colour);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(data["series"][i]["of"], i);
    EXPECT_EQ(data["series"][i]["colour"], look_of(i).colour);
    EXPECT_EQ(data["series"][i]["dashes"], look_of(i).dashes);
    EXPECT_EQ(data["series"][i]["symbol"], look_of(i).symbol);
  }
}

TEST(ExperimentsPlotData, SpeedUpsHaveBothLaws) {
  auto plot = make_example();
  plot.is_speedup = true;
  const auto serials = [&](const std::string& law) {
    std::vector<std::pair<int, double>> found;
    const auto data = json::parse(make_plot_data(plot, TABLE));
    for (const auto& fitted : data["laws"])
      if (fitted["law"] == law) found.push_back({fitted["of"], fitted["serial"]});
    return found;
  };
  auto amdahl = serials("Amdahl's law"), gustafson = serials("Gustafson's law");
  ASSERT_EQ(amdahl.size(), 2u);
  ASSERT_EQ(gustafson.size(), 2u);
  EXPECT_EQ(amdahl[0].first, 0);
  EXPECT_NEAR(amdahl[0].second, 0.1, 1e-12);
  EXPECT_EQ(gustafson[1].first, 1);
  EXPECT_NEAR(gustafson[1].second, 0.2, 1e-12);
  plot.series.push_back(
      {.name = "Amdahl's law (± 95 %)", .x = {1}, .y = {1}, .kind = SeriesKind::law});
  EXPECT_TRUE(serials("Amdahl's law").empty()) << "it is drawn already";
  EXPECT_EQ(serials("Gustafson's law").size(), 2u);
  for (double& y : plot.series[1].y) y *= 4;  // above the ideal: no serial fraction gives this
  EXPECT_EQ(serials("Gustafson's law").size(), 1u);
}

TEST(ExperimentsPlotData, WhatIsNoNumberIsNoPoint) {
  auto plot = make_example();
  plot.series[0].y[1] = NAN;
  plot.series[0].x[3] = INFINITY;
  plot.series[0].fitted = "s = 1";
  plot.differences = {{.name = "", .x = {1, 2}, .y = {3, NAN}, .of = 1}};
  plot.difference_label = "difference [%]";
  const auto data = json::parse(make_plot_data(plot, TABLE));
  const auto& points = data["series"][0]["points"];
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1][2], 8) << "its row goes with it";
  EXPECT_EQ(data["series"][0]["name"], "a (s = 1)");
  EXPECT_EQ(data["difference"]["label"], "difference [%]");
  EXPECT_EQ(data["difference"]["series"][0]["points"], json::parse("[[1.0, 3.0]]"));
  EXPECT_EQ(data["difference"]["series"][0]["colour"], look_of(1).colour);
}

}  // namespace
}  // namespace laboratory

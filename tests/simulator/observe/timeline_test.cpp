// The Gantt chart as SVG: its data and its drawing.
#include "simulator/observe/timeline.hpp"

#include <gtest/gtest.h>

#include <set>

#include <algorithm>
#include <map>
#include <numeric>
#include <regex>
#include <vector>

#include "tests/simulator/observe/trace_support.hpp"

namespace observe {
namespace {

double sum(const TimelineRow::Shares& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

TEST(Timeline, SharesAddUpToTheTimeOfSpansAndTransfers) {
  constexpr std::size_t COLUMNS = 100;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Trace trace = make_random_trace(seed);
    const auto timeline = make_timeline(trace, trace.processors.size(), COLUMNS);
    std::vector<TimelineRow::Shares> cpus(trace.processors.size());
    std::vector<double> links(trace.links.size());
    const double column_s = (trace.end_s - trace.begin_s) / COLUMNS;
    for (const auto& span : trace.spans)
      cpus[span.processor][static_cast<std::size_t>(span.doing)] +=
          (span.to_s - span.from_s) / column_s;
    for (const auto& transfer : trace.transfers)
      links[transfer.link] += (transfer.to_s - transfer.from_s) / column_s;
    const auto expect_row = [&](const TimelineRow& row, const TimelineRow::Shares& expected) {
      TimelineRow::Shares found{};
      for (const auto& column : row.columns) {
        EXPECT_LE(sum(column), 1 + 1e-9);
        for (std::size_t i = 0; i < column.size(); ++i) found[i] += column[i];
      }
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6);
      EXPECT_NEAR(row.busy_s, sum(expected) * column_s, 1e-9);
    };
    for (std::size_t i = 0; i < cpus.size(); ++i) expect_row(timeline.cpus[i], cpus[i]);
    for (std::size_t i = 0; i < links.size(); ++i)
      expect_row(timeline.links[i], {links[i], 0.0, 0.0});
  }
}

TEST(Timeline, LeavesIdleColumnsEmpty) {
  const auto timeline = make_timeline(make_small_trace(), 2, 10);
  const auto& farmer = timeline.cpus[0].columns;
  EXPECT_NEAR(farmer[0][static_cast<std::size_t>(Trace::Doing::low)], 1, 1e-12);
  for (std::size_t i = 1; i < 10; ++i) EXPECT_LT(sum(farmer[i]), 1e-12);
  EXPECT_TRUE(timeline.links[1].columns.empty());  // a link without messages
}

// If a process is interrupted for less than a column, its bar must continue. A longer gap must end
// it.
TEST(Timeline, JoinsWhatBelongsToOneProcess) {
  using enum Trace::Doing;
  Trace trace = make_small_trace();
  trace.processes.push_back({"other", 0});
  trace.spans.clear();
  for (const double begin_s : {0.0, 0.007}) {
    trace.spans.push_back({begin_s, begin_s + 0.001, 0, 0, low});
    trace.spans.push_back({begin_s + 0.001, begin_s + 0.00105, 0, 2, high});
    trace.spans.push_back({begin_s + 0.00105, begin_s + 0.002, 0, 0, low});
  }
  const auto stretches = make_timeline(trace, 2, 100).stretches[0];
  ASSERT_EQ(stretches.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(stretches[i].process, 0u);
    EXPECT_NEAR(stretches[i].from, i == 0 ? 0 : 70, 1e-9);
    EXPECT_NEAR(stretches[i].to, i == 0 ? 20 : 90, 1e-9);
  }
}

// Expects that elements are closed in order, attributes are quoted, and no & or < is unescaped.
void expect_well_formed(const std::string& xml) {
  static const std::regex token(
      R"re(<(/?)([a-z]+)((?: [a-zA-Z-]+="[^"<]*")*) ?(/?)>|[^<&\x01-\x08]|&(?:amp|lt|gt|quot);)re");
  std::vector<std::string> open;
  auto at = xml.cbegin();
  for (std::smatch match; at != xml.cend(); at = match[0].second) {
    ASSERT_TRUE(
        std::regex_search(at, xml.cend(), match, token, std::regex_constants::match_continuous))
        << xml.substr(static_cast<std::size_t>(at - xml.cbegin()), 80);
    if (!match[2].matched || match[4] == "/") continue;
    if (match[1] == "/") {
      ASSERT_FALSE(open.empty());
      ASSERT_EQ(open.back(), match[2]);
      open.pop_back();
    } else {
      open.push_back(match[2]);
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(TimelineSvg, IsWellFormed) {
  expect_well_formed(saved(save_timeline, {}));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    expect_well_formed(saved(save_timeline, make_random_trace(seed)));
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Two processes wait for each other; a third process waits for them. Arrows show only the cycle of
// the two processes.
TEST(TimelineSvg, ADeadlockIsMarked) {
  Trace trace = make_small_trace();
  EXPECT_FALSE(contains(saved(save_timeline, trace), "waits for"));
  trace.fault = "deadlock <at> 0.01 s";
  trace.waiting = {{"give", "out on task", 0}, {"take", "in on task", 1}, {"other", "a timer", 1}};
  trace.cycle = 2;
  const auto svg = saved(save_timeline, trace);
  expect_well_formed(svg);
  for (const char* text : {"deadlock &lt;at&gt; 0.01 s", "give on farmer waits for out on task",
                           "other on worker waits for a timer"})
    EXPECT_TRUE(contains(svg, text)) << text;
  std::size_t arrows = 0;
  for (auto at = svg.find("\"wait\""); at != svg.npos; at = svg.find("\"wait\"", at + 1)) ++arrows;
  EXPECT_EQ(arrows, 2u);
}

// A page has 1380 columns, so a tenth of the window is 138 of them. A CPU's row is 26 pixels high.
TEST(TimelineSvg, DrawsBarsWhereTimeIsBusy) {
  const auto svg = saved(save_timeline, make_small_trace());
  EXPECT_TRUE(contains(svg, R"(<path class="low" fill="#9ecae1" d="M0 0H0V-26H138V0H1380V0Z"/>)"));
  EXPECT_TRUE(contains(svg, R"(class="message" fill="#41ab5d" d="M0 0H138V-9H552V0H1380V0Z"/>)"));
  EXPECT_TRUE(
      contains(svg, R"(class="switching" fill="#3b3b3b" d="M0 0H552V-26H1380V0H1380V0Z"/>)"));
  for (const char* text : {">small<", ">farmer<", ">worker<", ">to worker<", ">give<", ">take<",
                           ">10.0 %<", ">60.0 %<", ">30.0 %<", ">ms<", ">10<", ">high priority<"})
    EXPECT_TRUE(contains(svg, text)) << text;
  EXPECT_FALSE(contains(svg, "to farmer"));  // no message was sent there
}

// A bar may begin or end within a column.
TEST(TimelineSvg, DrawsEdgesBetweenPixels) {
  Trace trace = make_small_trace();
  trace.spans = {{10.2 * 0.01 / 1380, 20.7 * 0.01 / 1380, 0, 0, Trace::Doing::low}};
  EXPECT_TRUE(contains(saved(save_timeline, trace), "d=\"M0 0H10.2V-26H20.7V0H1380V0Z\""));
}

// A single span that is shorter than a pixel must stay visible.
TEST(TimelineSvg, DrawsTheShortestSpan) {
  Trace trace = make_small_trace();
  trace.spans = {{0.005, 0.005000001, 0, 0, Trace::Doing::high}};
  EXPECT_TRUE(contains(saved(save_timeline, trace), "d=\"M0 0H690V-1H691V0H1380V0Z\""));
}

// Half of each column is busy, in periods too short to draw, so bars must have half the height.
TEST(TimelineSvg, DrawsSharesAsHeights) {
  Trace trace = make_small_trace();
  trace.spans.clear();
  for (int i = 0; i < 13800; ++i)
    trace.spans.push_back({i * 0.01 / 13800, (i + 0.5) * 0.01 / 13800, 0, 0, Trace::Doing::low});
  const auto svg = saved(save_timeline, trace);
  EXPECT_TRUE(contains(svg, R"(class="low" fill="#9ecae1" d="M0 0H0V-13H1380V0Z"/>)"));
  EXPECT_LT(svg.size(), 6000u);
}

TEST(TimelineSvg, SaysHowManyProcessorsItLeavesOut) {
  Trace trace = make_small_trace();
  EXPECT_FALSE(contains(saved(save_timeline, trace), "processors"));
  trace.processors.resize(100, "more");
  trace.spans.push_back({0, 0.01, 99, 0, Trace::Doing::low});
  trace.links.push_back({99, 0});
  trace.transfers.push_back({0, 0.01, 2, 0, 1});
  const auto svg = saved(save_timeline, trace);
  expect_well_formed(svg);
  EXPECT_TRUE(contains(svg, "the first 64 of 100 processors"));
}

// The names, the time axis and the percentages of a figure fill exactly its width. The legend is
// broken into several lines.
TEST(Timeline, OfAFigureHasItsWidthAndFont) {
  const base::FigureStyle style{.width_mm = 85, .font = "DejaVu Serif", .font_pt = 8};
  const auto svg = draw_timeline(make_small_trace(), style);
  expect_well_formed(svg);
  EXPECT_TRUE(contains(svg, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"85mm\""));
  EXPECT_TRUE(contains(svg, "viewBox=\"0 0 240.94 "));
  EXPECT_TRUE(contains(svg, "font-family=\"DejaVu Serif\" font-size=\"8\""));
  EXPECT_FALSE(contains(svg, "class=\"paper\""));
  std::set<std::string> lines;  // heights of the legend's texts
  for (const auto* name : {"low priority", "message on a link"}) {
    const auto end = svg.find(std::string(">") + name), y = svg.rfind("y=\"", end);
    lines.insert(svg.substr(y, end - y));
  }
  EXPECT_EQ(lines.size(), 2u);
  EXPECT_TRUE(contains(saved(save_timeline, make_small_trace()), "class=\"paper\""));
}

}  // namespace
}  // namespace observe

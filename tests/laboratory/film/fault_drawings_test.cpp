// Drawings that `tlab run` makes after a deadlock or another fault.
#include "experiments/laboratory/film/fault_drawings.hpp"

#include <algorithm>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

int count_waits(const std::string& svg) {
  int count = 0;
  for (auto at = svg.find("class=\"wait\""); at != std::string::npos;
       at = svg.find("class=\"wait\"", at + 1))
    ++count;
  return count;
}

// Four stations wait for each other in a ring.
TEST(FaultDrawings, ADeadlockLeavesItsCycleAndATimeLine) {
  const TemporaryFolder folder;
  write_file(folder.path / "d.toml", "title = \"Four\"\n[program]\nname = \"deadlock\"\n");
  const auto outcome = tlab(folder.path, {"run", "d.toml", "-o", "r"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(contains(outcome.err, "\n  who waits for whom: r-fault.svg\n")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "r-fault-timeline.svg\n")) << outcome.err;
  for (const char* file : {"r-fault.svg", "r-fault-timeline.svg"}) {
    const auto svg = read_file(folder.path / file);
    EXPECT_EQ(count_waits(svg), 4) << file;
    EXPECT_TRUE(contains(svg, "<title>Four</title>")) << file;
    EXPECT_TRUE(contains(svg, "deadlock at 0.0001")) << file;
    EXPECT_TRUE(contains(svg, "p0.station on p0 waits for out on p1.in")) << file;
  }
  EXPECT_FALSE(fs::exists(folder.path / "r-fault.pdf")) << "the experiment asks for no figures";
  // a second run replaces the files
  EXPECT_EQ(tlab(folder.path, {"run", "d.toml", "-o", "r"}).exit_code, 3);
}

TEST(FaultDrawings, ArePdfIfTheReportAsksForFigures) {
  const TemporaryFolder folder;
  write_file(folder.path / "d.toml",
             "[program]\nname = \"deadlock\"\n[report]\nwidth = \"column\"\n");
  const auto outcome = tlab(folder.path, {"run", "d.toml", "-o", "r"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(contains(outcome.err, "who waits for whom: r-fault.svg, r-fault.pdf\n"));
  EXPECT_TRUE(contains(read_file(folder.path / "r-fault.svg"), "class=\"paper\""))
      << "the SVG stays a drawing for the screen";
  for (const char* file : {"r-fault.pdf", "r-fault-timeline.pdf"}) {
    const auto pdf = read_file(folder.path / file);
    EXPECT_TRUE(pdf.starts_with("%PDF")) << file;
    EXPECT_TRUE(contains(pdf, "/MediaBox [ 0 0 240.94")) << file << ": 85 mm are 240.94 points";
  }
}

// Two processors that wait for each other: each arrow has a head and is apart from the other.
TEST(FaultDrawings, AFigureHasItsSizeAndWrapsItsTexts) {
  observe::Trace trace;
  trace.title = "Two";
  trace.processors = {"a", "b"};
  trace.links = {{0, 1}, {1, 0}};
  trace.fault = "deadlock at 1 s";
  const std::string what = "a text that needs more letters than a line has";
  trace.waiting = {{"p", what, 0}, {"q", what, 1}};
  trace.cycle = 2;
  const topologies::Places places = {{0, 0}, {1, 0}};
  const auto figure = draw_waits(trace, places, {.width_mm = 85}),
             screen = draw_waits(trace, places);
  EXPECT_TRUE(contains(figure, "<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_TRUE(contains(figure, "width=\"85mm\""));
  EXPECT_FALSE(contains(figure, "class=\"paper\"")) << "transparent";
  const auto sentence = "p on a waits for " + what;
  EXPECT_TRUE(contains(screen, ">" + sentence + "<")) << screen;
  EXPECT_FALSE(contains(figure, ">" + sentence + "<")) << "broken into lines";
  EXPECT_EQ(count_waits(figure), 2);
  std::size_t heads = 0;
  for (auto at = figure.find("<path fill=\"#b40000\""); at != figure.npos;
       at = figure.find("<path fill=\"#b40000\"", at + 1))
    ++heads;
  EXPECT_EQ(heads, 2u);
}

// The naive router deadlocks, Chalmers's does not.
TEST(FaultDrawings, TheOtherPointsOfASweepStay) {
  const TemporaryFolder folder;
  write_file(folder.path / "e.toml",
             "[program]\nname = \"soak\"\nbuffers = 3000\n[network]\ntopology = \"mesh:3x3\"\n"
             "[sweep]\nmethod = [\"chalmers\", \"naive\"]\n");
  const auto outcome = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_TRUE(contains(read_file(folder.path / "r/results.csv"), "done\n"));
  const auto drawing = folder.path / "r-fault-method-naive.svg";
  EXPECT_TRUE(contains(outcome.err, "r-fault-method-naive.svg")) << outcome.err;
  EXPECT_GE(count_waits(read_file(drawing)), 2);
  EXPECT_FALSE(fs::exists(folder.path / "r-fault-method-chalmers.svg"));
}

// A router whose buffers are full ends the run with a fault of its process.
TEST(FaultDrawings, AnotherFaultLeavesATimeLine) {
  const TemporaryFolder folder;
  write_file(folder.path / "e.toml",
             "[program]\nname = \"soak\"\nin_path_share = 0.8\n[network]\ntopology = "
             "\"mesh:3x3\"\n[[fault]]\nat_s = 0.02\nlink = [0, 1]\n");
  const auto outcome = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  const auto svg = read_file(folder.path / "r-fault-timeline.svg");
  EXPECT_EQ(count_waits(svg), 0);
  EXPECT_TRUE(contains(svg, "no free buffer")) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path / "r-fault.svg"));
}

// A run with timed costs and a run of two minutes are not repeated after a fault, so there is no
// drawing.
TEST(FaultDrawings, NothingIsDrawnOfRunsThatAreNotRepeated) {
  Point point;
  PointResult failure;
  failure.fault_s = 1;
  failure.host.total_s = 120;
  EXPECT_EQ(draw_fault(point, {}, failure, {}), "");
  failure.host.total_s = 1;
  point.experiment.is_timed = true;
  EXPECT_EQ(draw_fault(point, {}, failure, {}), "");
}

}  // namespace
}  // namespace laboratory

// Declared plots and answers to [[best]] in a complete run: their files, and errors for mistakes.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

// The work grows with the number of workers.
const std::string FIGURES =
    "[program]\nname = \"law\"\nscaled = 1\n[sweep]\nserial_fraction = [0.05, 0.2]\n"
    "\"workers, work_cycles\" = [[1, 10000000], [2, 20000000], [4, 40000000]]\n";

struct Trial {
  TemporaryFolder folder;
  Outcome outcome;
  explicit Trial(const std::string& text) {
    std::ofstream(folder.path / "e.toml") << text;
    outcome = tlab(folder.path, {"run", "e.toml", "-o", "out"});
  }
  std::string read(const std::string& name) const { return read_file(folder.path / "out" / name); }
};

TEST(ExperimentsFigures, ARunWritesWhatItFound) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const Trial run(FIGURES +
                  "[[plot]]\nname = \"gustafson\"\nx = \"processors\"\ny = \"speedup\"\n"
                  "fit = \"gustafson\"\noptimum = true\n"
                  "[[best]]\nname = \"most\"\nof = \"speedup\"\nleast = false\n"
                  "over = [\"serial_fraction\"]\npays = \"processors\"\n");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const auto fits = parse_csv(run.read("fits.csv"), "fits.csv");
  ASSERT_EQ(fits.rows.size(), 2u) << "coupled axes make one curve";
  EXPECT_NEAR(*as_number(fits.rows[1][*fits.find("value")]), 0.2, 0.02);
  EXPECT_EQ(parse_csv(run.read("best.csv"), "best.csv").rows.size(), 3u);
  EXPECT_EQ(parse_csv(run.read("pays.csv"), "pays.csv").rows.size(), 2u);
  EXPECT_TRUE(contains(run.read("plots/gustafson.svg"), "Gustafson's law"));
  EXPECT_FALSE(std::filesystem::exists(run.folder.path / "out/plots/speedup.svg"));
  const auto html = run.read("report.html");
  for (const char* part : {"What was found", "serial fraction 0.05: serial fraction by Gustafson:",
                           "still rising at 4", "<h3>most</h3>"})
    EXPECT_TRUE(contains(html, part)) << part;
  // The folder has only files of tlab, so the next run may replace it.
  EXPECT_EQ(tlab(run.folder.path, {"run", "e.toml", "-o", "out"}).exit_code, 0);
}

// A click on a point shows the loads in its record. The table also shows the largest of these
// loads.
TEST(ExperimentsFigures, ThePageKnowsWhyPointsAreNotFaster) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const Trial run(
      "[image]\nwidth = 6\nheight = 4\n[scene]\nobjects = 9\n[sweep]\nworkers = [1, 2, 4]\n");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const auto html = run.read("report.html");
  const auto begin = html.find('{', html.find("<script type=\"application/json\""));
  const auto data = nlohmann::json::parse(html.substr(begin, html.find("</", begin) - begin));
  const auto table = parse_csv(run.read("results.csv"), "results.csv");
  ASSERT_EQ(data["points"].size(), table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& loads = data["points"][i]["loads"];
    ASSERT_GT(loads.size(), 3u);
    EXPECT_EQ(loads[0][0], to_string(table.rows[i][*table.find("busiest")]));
    EXPECT_EQ(loads[1][1], *as_number(table.rows[i][*table.find("next_busy")]));
    EXPECT_TRUE(contains(html, fmt::format("data-point=\"{}\"", i)));
  }
  ASSERT_EQ(data["plots"].size(), 4u);
  const auto& speedup = data["plots"][2];
  EXPECT_EQ(speedup["laws"].size(), 2u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(speedup["series"][0]["points"][i][1],
              *as_number(table.rows[i][*table.find("speedup")]));
  EXPECT_TRUE(contains(html, "<li>Limited by ") || contains(html, "<li>Nothing is saturated"));
}

// A point that was ended before its first task has no busy time, so the page shows no loads.
TEST(ExperimentsFigures, PointsWithoutTimeHaveAReport) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << "[image]\nwidth = 6\nheight = 4\n";
  const auto outcome = tlab(folder.path, {"run", "e.toml", "-o", "out", "--until", "1e-4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto html = read_file(folder.path / "out/report.html");
  EXPECT_TRUE(contains(html, "\"ended\":\"limit\""));
  EXPECT_TRUE(contains(html, "\"loads\":[]"));
}

// The report omits settings without effect, such as `workers` for a topology with a size of its
// own.
TEST(ExperimentsFigures, TheReportSaysWhatRan) {
  const Trial run(
      "[image]\nwidth = 6\nheight = 4\n[network]\ntopology = \"ring:3\"\nworkers = 5\n"
      "[model.link]\none_way_rate = 1e6\n[report]\nnetworks = \"all\"\n"
      "[sweep]\nsource = [\"spheres:9\", \"hills:20\"]\n");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const auto html = run.read("report.html");
  for (const char* part :
       {"<dt>Machine</dt><dd>t805-25</dd>", "<dt>model.link.one_way_rate</dt><dd>1000000</dd>",
        "<dt>Network</dt><dd>ring:3, workers: 3</dd>", "<dt>objects</dt><dd>9, 20</dd>",
        "<figcaption>topology = ring:3, workers = 3, objects = 20, source = "
        "hills:20</figcaption>",
        "\n# machine.model = &quot;t805-25&quot;\n", "\n# image.depth = 15\n",
        "\n# data.in_path = true\n"})
    EXPECT_TRUE(contains(html, part)) << part;
  for (const char* part :
       {"# image.width", "# scene.objects", "# network.workers", "# scene.source"})
    EXPECT_FALSE(contains(html, part)) << part;
}

TEST(ExperimentsFigures, ARunJsonOfOtherPointsIsRefused) {
  const Trial run("[program]\nname = \"message\"\n[sweep]\nbytes = [1, 2]\n");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const auto whole = nlohmann::json::parse(run.read("run.json"));
  const auto report = [&](const nlohmann::json& json) {
    std::ofstream(run.folder.path / "out/run.json") << json;
    return tlab(run.folder.path, {"report", "out"});
  };
  EXPECT_EQ(report(whole).exit_code, 0);
  auto empty = whole, other = whole, broken = whole;
  empty["points"] = nlohmann::json::array();
  other["experiment"] = "[program]\nname = \"message\"\n[sweep]\nbytes = [1, 3]\n";
  broken["experiment"] = "program.name = message\n";
  const auto expect_refused = [&](const nlohmann::json& json, const std::string& told) {
    const auto refused = report(json);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_TRUE(contains(refused.err, told)) << refused.err;
  };
  expect_refused(empty, "run.json: damaged: found no points");
  expect_refused(other, "damaged: found a record of the point \"bytes = 2\"");
  expect_refused(broken, "tlab: out/run.json: e.toml:1: ");
  auto far = whole;
  far["file"] = std::string(300, 'x') + "/e.toml";
  expect_refused(far, "x: File name too long");
}

TEST(ExperimentsFigures, MistakesAreNamedAfterTheFirstPointAtTheLatest) {
  const Trial plot(FIGURES + "[[plot]]\nname = \"p\"\nx = \"processors\"\ny = \"spedup\"\n");
  EXPECT_EQ(plot.outcome.exit_code, 2);
  EXPECT_TRUE(contains(plot.outcome.err,
                       "plot \"p\": y: unknown variable \"spedup\", the nearest is \"speedup\""))
      << plot.outcome.err;
  EXPECT_FALSE(std::filesystem::exists(plot.folder.path / "out/results.csv"));
  const Trial best(FIGURES + "[[best]]\nname = \"b\"\nof = \"speedup\"\nover = [\"workers\"]\n");
  EXPECT_EQ(best.outcome.exit_code, 2);
  EXPECT_TRUE(
      contains(best.outcome.err, "best \"b\": over: \"workers\" is not an axis of the results"))
      << best.outcome.err;
}

}  // namespace
}  // namespace laboratory

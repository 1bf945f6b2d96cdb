// The command tlab as users see it: exit codes, files, and the same bytes in every run.
#include "experiments/laboratory/command/commands.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"
#include "tests/support/places.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// Arguments that run the experiment of the farm at reduced size.
const std::vector<std::string> SMALL = {"run",   ::test::in_sources("experiments/farm.toml"),
                                        "--set", "image.width=16",
                                        "--set", "image.height=12",
                                        "--set", "sweep.objects=[20, 60]",
                                        "--set", "sweep.workers=[1, 3]"};

std::vector<std::string> small(std::vector<std::string> more) {
  std::vector<std::string> all = SMALL;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(ExperimentsCommand, RunWritesEverythingAndTheSameBytesForAnyJobs) {
  const TemporaryFolder folder;
  for (const char* jobs : {"1", "3"}) {
    const auto done = tlab(folder.path, small({"-o", std::string("r") + jobs, "--jobs", jobs}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("speedup"), std::string::npos);
    EXPECT_NE(done.out.find("report.html"), std::string::npos);
    EXPECT_EQ(done.err, "");  // a pipe gets no progress bar
  }
  for (const char* name :
       {"results.csv", "report.html", "image-spheres-20.png", "image-spheres-60.png"})
    EXPECT_EQ(read_file(folder.path / "r1" / name), read_file(folder.path / "r3" / name)) << name;
  for (const char* name : {"run.json", "plots/speedup.svg", "plots/speedup.png", "plots/time_s.svg",
                           "plots/efficiency.png"})
    EXPECT_TRUE(fs::exists(folder.path / "r1" / name)) << name;
  // no temporary files remain
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"r1", "r3"}));

  const Table table = parse_csv(read_file(folder.path / "r1/results.csv"), "results.csv");
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.columns[0], "topology");
  EXPECT_EQ(table.columns[1], "workers");
  EXPECT_EQ(table.columns[2], "objects");
  for (const auto& row : table.rows) {
    const double time = *as_number(row[*table.find("time_s")]);
    const double rays = *as_number(row[*table.find("rays")]);
    EXPECT_DOUBLE_EQ(*as_number(row[*table.find("time_per_ray_ms")]), time / rays * 1e3);
    EXPECT_DOUBLE_EQ(
        *as_number(row[*table.find("efficiency")]) * *as_number(row[*table.find("workers")]),
        *as_number(row[*table.find("speedup")]));
  }
}

TEST(ExperimentsCommand, AsManyJobsAsTheHostHasProcessors) {
  CLI::App command;
  RunOptions options;
  add_run_options(command, options, "", "");
  EXPECT_EQ(options.jobs, std::max(1u, std::thread::hardware_concurrency()));
}

// The profile has a title and one line for each point.
TEST(ExperimentsCommand, ProfileShowsTheHostsTimeOfEachPoint) {
  const TemporaryFolder folder;
  const auto done = tlab(folder.path, small({"-o", "r", "--profile"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto at = done.out.find("host CPU time, microseconds");
  ASSERT_NE(at, std::string::npos) << done.out;
  std::istringstream lines(done.out.substr(at));
  std::size_t points = 0;
  for (std::string line; std::getline(lines, line);)
    points += line.find(" us (kernel ") != line.npos;
  EXPECT_EQ(points, 4u) << done.out;
}

TEST(ExperimentsCommand, FarmImageIsTheRenderersFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(tlab(folder.path, small({"-o", "r"})).exit_code, 0);
  ASSERT_EQ(tlab(folder.path,
                 {"render", "spheres:60", "-o", "i.png", "--size", "16x12", "--stats", "s.json"})
                .exit_code,
            0);
  EXPECT_EQ(read_file(folder.path / "i.png"), read_file(folder.path / "r/image-spheres-60.png"));
  EXPECT_NE(read_file(folder.path / "s.json").find("\"primary\": 192"), std::string::npos);
}

TEST(ExperimentsCommand, PreviewsAreThereBeforeTheFirstRay) {
  const TemporaryFolder folder;
  const auto stats = [&](const std::string& step) {
    EXPECT_EQ(tlab(folder.path, {"render", "spheres:60", "-o", step + ".png", "--preview", step,
                                 "--size", "16x12", "--stats", "s.json"})
                  .exit_code,
              0);
    return nlohmann::json::parse(read_file(folder.path / "s.json"));
  };
  const auto flat = stats("flat"), shadows = stats("shadows");
  EXPECT_EQ(flat["work"]["ray_intersected"], 0);
  EXPECT_GE(flat["preview"]["pixels_drawn"], 16 * 12 / 2);
  // Each pixel that shows an object has one shadow feeler to each of three lights.
  EXPECT_EQ(shadows["work"]["ray_intersected"].get<int>() % 3, 0);
  EXPECT_GT(shadows["work"]["ray_intersected"], 0);
  EXPECT_NE(read_file(folder.path / "flat.png"), read_file(folder.path / "shadows.png"));
}

TEST(ExperimentsCommand, OlderResultsAreReplacedButNeverSomethingElse) {
  const TemporaryFolder folder;
  const auto run = small({"-o", "r", "--set", "sweep.workers=[1]"});
  ASSERT_EQ(tlab(folder.path, run).exit_code, 0);
  ASSERT_EQ(tlab(folder.path, run).exit_code, 0);
  fs::create_directory(folder.path / "mine");
  std::ofstream(folder.path / "mine/thesis.txt") << "years of work";
  const auto refused = tlab(folder.path, small({"-o", "mine"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(read_file(folder.path / "mine/thesis.txt"), "years of work");
  // A file of the user inside a results folder is protected too.
  std::ofstream(folder.path / "r/thesis.txt") << "years of work";
  EXPECT_EQ(tlab(folder.path, run).exit_code, 2);
  EXPECT_EQ(read_file(folder.path / "r/thesis.txt"), "years of work");
  fs::remove(folder.path / "r/thesis.txt");
  std::ofstream(folder.path / "r/plots/notes.md") << "mine";
  EXPECT_EQ(tlab(folder.path, run).exit_code, 2);
  EXPECT_EQ(read_file(folder.path / "r/plots/notes.md"), "mine");
}

struct Mistake {
  std::vector<std::string> arguments;
  int exit_code;
  const char* message;
};

TEST(ExperimentsCommand, MistakesHaveTheirExitCodesAndLeaveNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "cut.nff") << "v\nfrom 0 0 5\nat 0 0 0\nup 0 1";
  std::ofstream(folder.path / "noise.nff") << "\x01\xff\x00garbage\n";
  std::ofstream(folder.path / "five.dot") << "graph { a--b a--c a--d a--e a--f }";
  const auto before = folder.names();
  for (const auto& [arguments, exit_code, message] : std::vector<Mistake>{
           {{}, 2, "subcommand is required"},
           {{"fly"}, 2, "unknown command"},
           {{"render", "cut.nff", "-o", "i.png"}, 2, "cut.nff:4"},
           {{"render", "noise.nff", "-o", "i.png"}, 2, "noise.nff:1"},
           {{"render", "missing.nff", "-o", "i.png"}, 2, "missing.nff"},
           {{"render", "spheres:0", "-o", "i.png"}, 2, "spheres:0"},
           {{"render", "spheres:9", "-o", "i.png", "--size", "0x5"}, 2, "found 0 x 5"},
           {{"render", "spheres:9", "-o", "i.png", "--size", "5"}, 2, "expected WxH"},
           {{"render", "spheres:9", "-o", "i.png", "--size", "9999999x9999999"}, 2, "1 to 65536"},
           {{"render", "spheres:9", "-o", "no/such/i.png", "--size", "4x4"}, 2, "no/such/i.png"},
           {{"render", "spheres:9", "-o", "i.png", "--feelers", "no"}, 2, "--feelers"},
           {{"render", "spheres:9", "-o", "i.png", "--preview", "wire"}, 2, "one of points, edges"},
           {{"render", "spheres:9", "-o", "i.png", "--preview", "flat", "--depth", "2"},
            2,
            "--depth excludes --preview"},
           {{"topology", "five.dot"}, 2, "five.dot"},
           {{"topology", "tre:7"}, 2, "tree"},
           {{"topology", "line:99999999999"}, 2, "65536"},
           {{"model", "t9000"}, 2, "t805-25"},
           {{"run", "missing.toml"}, 2, "missing.toml"},
           {small({"--set", "image.width=0"}), 2, "image.width: found 0"},
           {small({"--set", "scene.object=3"}), 2, "scene.objects"},
           {small({"--set", "scene.source=cut.nff"}), 2, "axis objects"},
           {small({"--set", "network.topology=star", "--set", "sweep.workers=[6]"}), 2, "5 links"},
           {small({"--set", "machine.worker_memory_bytes=132000"}), 3, "asked for"},
       }) {
    const auto outcome = tlab(folder.path, arguments);
    const auto what = testing::PrintToString(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << what << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << what << outcome.err;
    EXPECT_EQ(folder.names(), before) << what;
  }
}

TEST(ExperimentsCommand, OnlyOnePointOfCountedCostsIsShownLive) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << "[network]\nworkers = 2\n[scene]\nobjects = 9\n";
  for (const auto& [setting, message] :
       {std::pair("sweep.workers=[1, 2]", "the experiment has 2 points, expected one"),
        std::pair("run.cost=timed", "found cost = \"timed\", expected \"counted\"")}) {
    // The command is refused before a page opens. The recording has an invalid name, but the
    // refusal of the setting comes first.
    const auto refused = tlab(
        folder.path, {"live", "e.toml", "--no-browser", "--record", "e.txt", "--set", setting});
    EXPECT_EQ(refused.exit_code, 2) << setting;
    EXPECT_NE(refused.err.find(message), std::string::npos) << refused.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"e.toml"});
  }
}

TEST(ExperimentsCommand, TopologiesAndModelsArePrinted) {
  const TemporaryFolder folder;
  EXPECT_NE(tlab(folder.path, {"topology", "mesh:4x4"}).out.find("diameter"), std::string::npos);
  EXPECT_NE(tlab(folder.path, {"topology", "ring:5", "--format", "dot"}).out.find("graph"),
            std::string::npos);
  EXPECT_EQ(
      tlab(folder.path, {"topology", "ring:5", "--format", "graphml", "-o", "r.graphml"}).exit_code,
      0);
  EXPECT_EQ(tlab(folder.path, {"topology", "r.graphml", "--format", "csv"}).out,
            tlab(folder.path, {"topology", "ring:5", "--format", "csv"}).out);
  const auto model = tlab(folder.path, {"model", "t800-20"});
  EXPECT_EQ(model.exit_code, 0);
  EXPECT_NE(model.out.find("calibrated"), std::string::npos);
}

}  // namespace
}  // namespace laboratory

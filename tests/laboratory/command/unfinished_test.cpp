// Runs that are ended early, and live runs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/one_point.hpp"
#include "tests/laboratory/support/tlab.hpp"
#include "tests/support/places.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string cell(const Table& table, const char* column, std::size_t row = 0) {
  return to_string(table.rows.at(row)[*table.find(column)]);
}

TEST(ExperimentsUntil, TheLimitIsInSimulatedSecondsAndTheResultsSayThatTheyAreIncomplete) {
  const TemporaryFolder folder;
  for (const char* until : {"0.001", "0.1", "1e6"}) {
    const auto done = tlab(folder.path, one_point({"-o", "r", "--until", until}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const Table table = parse_csv(read_file(folder.path / "r/results.csv"), "results");
    const auto run = json::parse(read_file(folder.path / "r/run.json"));
    const bool whole = until == std::string("1e6");
    EXPECT_EQ(cell(table, "ended"), whole ? "done" : "limit") << until;
    EXPECT_EQ(run["complete"], whole);
    EXPECT_NE(done.out.find(whole ? "Ended: done" : "1 cut short at the time limit"),
              std::string::npos)
        << done.out;
    if (until == std::string("0.1")) {
      const double setup = *as_number(table.rows[0][*table.find("setup_s")]);
      const double time = *as_number(table.rows[0][*table.find("time_s")]);
      // the point has results up to the limit on simulated time, 0.1 s
      EXPECT_NEAR(setup + time, 0.1, 1e-9);
      EXPECT_GT(*as_number(table.rows[0][*table.find("rays")]), 0);
    }
  }
}

TEST(ExperimentsUntil, AProgramThatIsCutShortHasNoNumbersAndChecksPassItOver) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml")
      << "[program]\nname = \"message\"\n[sweep]\nbytes = [10, 1000000]\n[[check]]\n"
         "name = \"c\"\nof = \"latency_s\"\nwithin_abs = 1\nformula = \"0\"\n";
  const auto done = tlab(folder.path, {"run", "e.toml", "-o", "r", "--until", "0.01"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Table table = parse_csv(read_file(folder.path / "r/results.csv"), "results");
  EXPECT_EQ(cell(table, "ended", 0), "done");
  EXPECT_EQ(cell(table, "ended", 1), "limit");
  EXPECT_EQ(cell(table, "latency_s", 1), "");
  EXPECT_NE(done.out.find("at 1 point(s)"), std::string::npos) << done.out;
}

// Starts tlab and interrupts it.
Outcome interrupt(const fs::path& folder, const std::vector<std::string>& arguments) {
  const pid_t pid = start_tlab(folder, arguments);
  // Waits until the first point has begun: until its folder exists, and some time longer.
  for (int i = 0; i < 500 && !fs::exists(folder / (".r.partial-" + std::to_string(pid))); ++i)
    usleep(10'000);
  usleep(300'000);
  kill(pid, SIGINT);
  return wait_for_tlab(folder, pid);
}

// Each of the three points would take hours. The two points that have begun are kept and marked as
// interrupted. The third point does not begin.
TEST(ExperimentsInterrupt, WhatWasMeasuredIsKeptAndMarked) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml")
      << "[image]\nwidth = 4000\nheight = 200\n[machine]\ndatabase_memory_bytes = 1000000000\n"
         "[sweep]\nworkers = [1, 2, 3]\n";
  const auto ended = interrupt(folder.path, {"run", "e.toml", "-o", "r", "--jobs", "2"});
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  const Table table = parse_csv(read_file(folder.path / "r/results.csv"), "results");
  ASSERT_EQ(table.rows.size(), 2u);
  for (std::size_t row : {0, 1}) EXPECT_EQ(cell(table, "ended", row), "interrupt");
  const auto run = json::parse(read_file(folder.path / "r/run.json"));
  EXPECT_EQ(run["complete"], false);
  EXPECT_NE(run["ended"].get<std::string>().find("1 not started"), std::string::npos);
}

// The picture that the user saved before the link was cut is kept.
TEST(ExperimentsDeadlock, WhatWasMeasuredBeforeACutIsKept) {
  const TemporaryFolder folder;
  const auto plain = tlab(folder.path, one_point({"-o", "plain"}));
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const auto cut = [&](const char* link, const char* output) {
    return tlab(folder.path,
                one_point({"-o", output, "--set", "order=[{at_s=0.01,save=\"early\"}]", "--set",
                           fmt::format("fault=[{{at_s=0.3,link={}}}]", link)}));
  };
  const auto done = cut("[0,1]", "r");
  EXPECT_EQ(done.exit_code, 3) << done.err;
  EXPECT_NE(done.err.find("link cut"), std::string::npos) << done.err;
  const Table table = parse_csv(read_file(folder.path / "r/results.csv"), "results");
  EXPECT_EQ(cell(table, "ended"), "deadlock");
  EXPECT_NE(cell(table, "time_s"), "");
  EXPECT_TRUE(fs::exists(folder.path / "r/image-spheres-20-early.png")) << done.out;
  EXPECT_NE(read_file(folder.path / "r/report.html").find("deadlocked"), std::string::npos);
  cut("[0,1]", "again");
  EXPECT_EQ(read_file(folder.path / "again/results.csv"), read_file(folder.path / "r/results.csv"));
}

TEST(ExperimentsTrace, FilesAreWrittenAndTheResultsAreTheSame) {
  const TemporaryFolder folder;
  ASSERT_EQ(tlab(folder.path, one_point({"-o", "plain"})).exit_code, 0);
  const auto done = tlab(folder.path, one_point({"-o", "traced", "--trace", "t.json", "--timeline",
                                                 "t.svg", "--from", "0.01"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(read_file(folder.path / "plain/results.csv"),
            read_file(folder.path / "traced/results.csv"));
  const auto trace = json::parse(read_file(folder.path / "t.json"));
  EXPECT_GT(trace["traceEvents"].size(), 1000u);
  EXPECT_NE(read_file(folder.path / "t.json").find("worker1.application"), std::string::npos);
  EXPECT_NE(read_file(folder.path / "t.svg").find("worker3"), std::string::npos);
  ASSERT_EQ(tlab(folder.path, one_point({"-o", "traced", "--trace", "t.paje"})).exit_code, 0);
  EXPECT_EQ(read_file(folder.path / "t.paje").substr(0, 9), "%EventDef");
}

TEST(ExperimentsTrace, AProgramThatFailsLeavesItsTraceAndNoResults) {
  const TemporaryFolder folder;
  const auto failed = tlab(folder.path, one_point({"-o", "r", "--timeline", "t.svg", "--set",
                                                   "machine.database_memory_bytes=146432"}));
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  EXPECT_NE(failed.err.find("out of memory"), std::string::npos) << failed.err;
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"r-fault-objects-20-workers-3-timeline.svg", "t.svg"}));
}

TEST(ExperimentsTrace, MistakesAreNamed) {
  const TemporaryFolder folder;
  const auto told = [&](const std::vector<std::string>& more) {
    const auto done = tlab(folder.path, one_point(more));
    EXPECT_EQ(done.exit_code, 2) << done.err;
    return done.err;
  };
  EXPECT_NE(told({"--trace", "t.txt"}).find("ends in .json or .paje"), std::string::npos);
  EXPECT_NE(told({"--timeline", "t.json"}).find("ends in .svg"), std::string::npos);
  EXPECT_NE(told({"--trace", "t.json", "--set", "sweep.workers=[1, 2]"}).find("has 2 points"),
            std::string::npos);
  EXPECT_NE(told({"-o", "r", "--trace", "no/such/folder/t.json"}).find("no/such/folder/t.json"),
            std::string::npos);
  told({"--until", "-1"});
  told({"--until", "soon"});
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(ExperimentsTimed, TheHostsSpeedIsRecorded) {
  const TemporaryFolder folder;
  const auto done = tlab(folder.path, one_point({"-o", "r", "--set", "run.cost=\"timed\""}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto run = json::parse(read_file(folder.path / "r/run.json"));
  const auto& speed = run["host_speed"]["t805-25"];
  EXPECT_GT(speed["cycles_per_host_s"].get<double>(), 0);
  EXPECT_GE(speed["repeats"].get<int>(), 3);
  EXPECT_GT(speed["clock_interval_s"].get<double>(), 0);
  double least = 1e99, most = 0;
  for (const char* workload : {"rays", "blocks", "radiosity"}) {
    const double cycles = speed["workloads"][workload]["cycles_per_host_s"].get<double>();
    least = std::min(least, cycles);
    most = std::max(most, cycles);
  }
  const double mean = speed["cycles_per_host_s"].get<double>();
  EXPECT_LE(least, mean);
  EXPECT_LE(mean, most);
  EXPECT_NEAR(speed["spread"].get<double>(), (most - least) / mean, 1e-9);
  for (const char* kernel : {"ray", "shading", "display"})
    EXPECT_GT(run["points"][0]["kernels"][kernel]["calls"].get<int>(), 0) << kernel;
  EXPECT_NE(done.out.find("cycles a second of host CPU"), std::string::npos);
}

// Runs only on request, because its result depends on the host's speed.
TEST(ExperimentsTimed, BothCostsGiveTheSameImageTimeOnAnIdleHost) {
  if (!std::getenv("TLAB_IDLE_HOST")) GTEST_SKIP() << "set TLAB_IDLE_HOST=1 on an idle host";
  const TemporaryFolder folder;
  const auto time_with = [&](const std::string& cost) {
    const auto done =
        tlab(folder.path,
             {"run", ::test::in_sources("experiments/farm.toml"), "-o", "r", "--set", "check=[]",
              "--set", "image.width=30", "--set", "image.height=30", "--set", "sweep.objects=[800]",
              "--set", "sweep.workers=[1]", "--set", "run.cost=\"" + cost + "\""});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const Table table = parse_csv(read_file(folder.path / "r/results.csv"), "results");
    return *as_number(table.rows[0][*table.find("time_s")]);
  };
  EXPECT_NEAR(time_with("timed") / time_with("counted"), 1, 0.25);
}

TEST(ExperimentsDeadlock, IsReportedWithItsCycleAndExitCode3) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << "[program]\nname = \"deadlock\"\n";
  const auto failed = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  EXPECT_EQ(failed.exit_code, 3);
  for (const char* part : {"deadlock at 0.", "p0.station on p0 waits for out on p1.in",
                           "from p1.station", "the cycle:"})
    EXPECT_NE(failed.err.find(part), std::string::npos) << part << "\n" << failed.err;
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"e.toml", "r-fault-timeline.svg", "r-fault.svg"}));
}

TEST(ExperimentsDeadlock, OfManyStationsIsToldWhole) {
  const TemporaryFolder folder;
  for (const char* sweep : {"", "[sweep]\n\"model.cpu.clock\" = [20e6]\n"}) {
    std::ofstream(folder.path / "e.toml") << "[program]\nname = \"deadlock\"\nstations = 40\n"
                                          << sweep;
    const auto failed = tlab(folder.path, {"run", "e.toml", "-o", "r"});
    EXPECT_EQ(failed.exit_code, 3);
    for (int i = 0; i < 40; ++i)
      EXPECT_NE(failed.err.find(fmt::format("\n  p{0}.station on p{0} waits for out on ", i)),
                std::string::npos)
          << i << failed.err;
    EXPECT_NE(failed.err.find("\n  the cycle: p0.station -> p"), std::string::npos) << failed.err;
    EXPECT_EQ(failed.err.find(" bytes) ... "), std::string::npos) << failed.err;
  }
}

TEST(ExperimentsSwitches, LinkSwitchesMakeLinksSlowerWhereTheyAre) {
  const TemporaryFolder folder;
  const auto time_with = [&](const std::string& switches) {
    const auto done = tlab(folder.path, one_point({"-o", "r", "--set", "network.topology=\"line\"",
                                                   "--set", "network.switches=" + switches}));
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const Table table = parse_csv(read_file(folder.path / "r/results.csv"), "results");
    return *as_number(table.rows[0][*table.find("time_s")]);
  };
  const double none = time_with("0"), some = time_with("[[1, 0, 3]]"), all = time_with("3");
  EXPECT_EQ(time_with("[[0, 1, 3], [1, 2, 3]]"), all);
  EXPECT_NE(some, none);
  EXPECT_NE(all, some);
  for (const char* bad : {"[[0, 2, 1]]", "17", "[[0, 1]]", "\"x\""})
    EXPECT_EQ(tlab(folder.path, one_point({"--set", "network.topology=\"line\"", "--set",
                                           std::string("network.switches=") + bad}))
                  .exit_code,
              2)
        << bad;
}

}  // namespace
}  // namespace laboratory

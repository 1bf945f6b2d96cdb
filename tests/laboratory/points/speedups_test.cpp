// Speed-ups in the results of programs.
#include "experiments/laboratory/points/results.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using I = std::int64_t;

Table make(std::vector<std::vector<Value>> rows) {
  return {.columns = {"topology", "processors", "time_s", "speedup", "efficiency", "ended"},
          .axes = 2,
          .rows = std::move(rows)};
}

TEST(ExperimentsSpeedups, AreAgainstOneProcessorAndOtherwiseTheSame) {
  auto table = make({{"mesh", I{4}, 2.5, {}, {}, "done"},
                     {"mesh", I{1}, 8.0, {}, {}, "done"},
                     {"line", I{1}, 9.0, {}, {}, "done"},
                     {"line", I{4}, 3.0, {}, {}, "done"},
                     {"line", I{2}, {}, {}, {}, "failed"},
                     {"ring", I{4}, 3.0, {}, {}, "done"}});
  add_speedups(table, "processors");
  EXPECT_EQ(table.rows[0][3], Value(8.0 / 2.5));
  EXPECT_EQ(table.rows[0][4], Value(8.0 / 2.5 / 4));
  EXPECT_EQ(table.rows[1][3], Value(1.0));
  EXPECT_EQ(table.rows[3][3], Value(3.0));
  EXPECT_EQ(table.rows[4][3], Value()) << "did not end";
  EXPECT_EQ(table.rows[5][3], Value()) << "no ring of one";
}

// The time of a point that was ended early gives no speed-up, neither for itself nor as the base of
// others.
TEST(ExperimentsSpeedups, NeedRunsThatCameToTheirEnd) {
  for (const char* ended : {"limit", "interrupt", "deadlock"}) {
    auto table = make({{"mesh", I{1}, 8.0, {}, {}, ended},
                       {"mesh", I{4}, 2.5, {}, {}, "done"},
                       {"line", I{1}, 9.0, {}, {}, "saturated"},
                       {"line", I{4}, 3.0, {}, {}, "done"},
                       {"line", I{2}, 1.0, {}, {}, ended}});
    add_speedups(table, "processors");
    for (const std::size_t row : {0, 1, 4}) {
      EXPECT_EQ(table.rows[row][3], Value()) << ended << ", row " << row;
      EXPECT_EQ(table.rows[row][4], Value()) << ended << ", row " << row;
    }
    EXPECT_EQ(table.rows[3][3], Value(3.0)) << ended;
  }
}

TEST(ExperimentsSpeedups, NeedAnAxisOfProcessors) {
  auto table = make({{"mesh", I{1}, 8.0, {}, {}, "done"}});
  table.axes = 1;
  add_speedups(table, "processors");
  EXPECT_EQ(table.rows[0][3], Value());
}

// The cells of a column in the results of a run, as strings.
std::vector<std::string> run_column(const TemporaryFolder& folder, const std::string& network,
                                    const std::string& column) {
  std::ofstream(folder.path / "e.toml") << "[image]\nwidth = 12\nheight = 8\n[scene]\nobjects = 9\n"
                                        << network;
  EXPECT_EQ(tlab(folder.path, {"run", "e.toml", "-o", "r"}).exit_code, 0);
  const auto table = parse_csv(read_file(folder.path / "r" / "results.csv"), "results.csv");
  std::vector<std::string> cells;
  for (const auto& row : table.rows) cells.push_back(to_string(row[*table.find(column)]));
  return cells;
}

// A single worker is simulated in addition only if the sweep has no point with one worker.
TEST(ExperimentsSpeedups, OfANetworkWithASizeOfItsOwnAreAgainstASingleWorker) {
  const TemporaryFolder folder;
  const auto records = [&] {
    std::size_t n = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder.path / "r" / "points"))
      n += entry.path().extension() == ".json" && entry.path().stem() != "experiment";
    return n;
  };
  const auto of_workers =
      run_column(folder, "[network]\ntopology = \"ring\"\n[sweep]\nworkers = [1, 3]\n", "speedup");
  ASSERT_EQ(of_workers.size(), 2u);
  std::filesystem::remove_all(folder.path / "r");
  const std::vector<std::string> alone{of_workers[1]};
  EXPECT_EQ(run_column(folder, "[network]\ntopology = \"ring:3\"\n", "speedup"), alone);
  EXPECT_EQ(records(), 2u);
  std::filesystem::remove_all(folder.path / "r");
  EXPECT_EQ(run_column(folder, "[sweep]\ntopology = [\"line:1\", \"ring:3\"]\n", "speedup"),
            of_workers);
  EXPECT_EQ(records(), 2u);
}

// A single worker that was ended early is no base for speed-ups, whether it belongs to the sweep or
// was simulated in addition.
TEST(ExperimentsSpeedups, ASingleWorkerThatIsCutShortIsNoBase) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << "[image]\nwidth = 12\nheight = 8\n[scene]\nobjects = 9\n"
                                           "[sweep]\ntopology = [\"line:1\", \"ring:3\"]\n";
  const auto run = [&](const std::string& until) {
    EXPECT_EQ(tlab(folder.path, {"run", "e.toml", "-o", "r", "--until", until}).exit_code, 0);
    const auto table = parse_csv(read_file(folder.path / "r" / "results.csv"), "results.csv");
    std::vector<std::string> cells;
    for (const char* column : {"ended", "speedup"})
      for (const auto& row : table.rows) cells.push_back(to_string(row[*table.find(column)]));
    return cells;
  };
  const auto whole = run("100");
  EXPECT_EQ(whole[0] + " " + whole[1], "done done");
  EXPECT_NE(whole[3], "");
  const auto cut = run("0.35");
  EXPECT_EQ(cut[0] + " " + cut[1], "limit done");
  EXPECT_EQ(cut[3], "");
}

}  // namespace
}  // namespace laboratory

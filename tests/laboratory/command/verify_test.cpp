// `tlab verify`, and the checks of `tlab run`: exit codes, output, and which points are simulated
// again.
#include <fstream>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

const std::string MESSAGES =
    "[program]\nname = \"message\"\n[sweep]\nbytes = [1, 100, 10000]\n"
    "[let]\nt_start = \"(channel.operands + channel.blocked) / cpu.clock\"\n";
const std::string HOLDS =
    "[[check]]\nname = \"right\"\nof = \"latency_s\"\nwithin = 1e-6\n"
    "formula = \"t_start + bytes / link.one_way_rate\"\n";
const std::string FAILS =
    "[[check]]\nname = \"wrong\"\nof = \"latency_s\"\nwithin = 0.01\n"
    "formula = \"bytes / link.one_way_rate\"\n";

TEST(ExperimentsVerify, AFailingCheckEndsWithOneAndKeepsResults) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << MESSAGES << HOLDS << FAILS;
  const auto run = tlab(folder.path, {"run", "e.toml"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(contains(run.out, "ok       right: latency_s at 3 point(s)")) << run.out;
  EXPECT_TRUE(contains(run.out, "FAILED   wrong: latency_s at 3 point(s)")) << run.out;
  EXPECT_TRUE(contains(run.err, "1 of 2 check(s) do not hold")) << run.err;
  const auto csv = parse_csv(read_file(folder.path / "results/e/checks.csv"), "checks.csv");
  EXPECT_EQ(csv.rows.size(), 6u);
  const auto report = read_file(folder.path / "results/e/report.html");
  EXPECT_TRUE(contains(report, "<h2>Checks</h2>"));
  EXPECT_TRUE(contains(report, "FAILED   wrong"));

  const auto verify = tlab(folder.path, {"verify", "e.toml"});
  EXPECT_EQ(verify.exit_code, 1);
  EXPECT_TRUE(contains(verify.out, "results were in results/e")) << verify.out;
  EXPECT_TRUE(contains(verify.out, "fails, worst")) << verify.out;
  EXPECT_TRUE(verify.out.ends_with("1 check(s) hold, 1 do not\n")) << verify.out;
}

TEST(ExperimentsVerify, ACheckOfNoPointFailsUnlessItMayBeEmpty) {
  const TemporaryFolder folder;
  for (const bool may_be_empty : {false, true})
    for (const auto* command : {"run", "verify"}) {
      std::ofstream(folder.path / "e.toml") << MESSAGES << HOLDS << "where = \"bytes > 1e6\"\n"
                                            << (may_be_empty ? "may_be_empty = true\n" : "");
      const auto done = tlab(folder.path, {command, "e.toml"});
      EXPECT_EQ(done.exit_code, may_be_empty ? 0 : 1) << command;
      EXPECT_TRUE(contains(done.out, may_be_empty ? "ok       right: latency_s at no point\n"
                                                  : "FAILED   right: latency_s at no point, "))
          << done.out;
    }
}

TEST(ExperimentsVerify, RunsOnlyWhatIsMissing) {
  const TemporaryFolder folder;
  auto write = [&](const std::string& text) { std::ofstream(folder.path / "e.toml") << text; };
  auto verify = [&](std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"verify", "e.toml"});
    const auto done = tlab(folder.path, more);
    EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
    return contains(done.out, "results were in");
  };
  write(MESSAGES + HOLDS);
  EXPECT_FALSE(verify());
  EXPECT_TRUE(verify());
  write(MESSAGES + HOLDS + "where = \"bytes > 1\"\n");
  EXPECT_TRUE(verify());  // another check needs no simulation
  EXPECT_FALSE(verify({"--set", "sweep.bytes=[2, 3]"}));
  EXPECT_FALSE(verify({"--set", "model.cpu.clock=20e6"}));
  EXPECT_TRUE(verify({"--set", "model.cpu.clock=20e6"}));
  EXPECT_TRUE(verify());  // the results of the first run are used again
  // one of these points has no result yet
  EXPECT_FALSE(verify({"--set", "sweep.bytes=[1, 100, 10001]"}));
  std::ofstream(folder.path / "results/e/results.csv") << "bytes,latency_s\n1,1.0\n";
  std::ofstream(folder.path / "results/e/run.json") << "{";
  EXPECT_TRUE(verify());  // writes the damaged files again, without a simulation
  EXPECT_EQ(parse_csv(read_file(folder.path / "results/e/results.csv"), "csv").rows.size(), 3u);
}

TEST(ExperimentsVerify, FoldersAreSearchedAndFilesWithoutChecksSkipped) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path / "all/deep");
  std::ofstream(folder.path / "all/b.toml") << MESSAGES << HOLDS;
  std::ofstream(folder.path / "all/deep/a.toml") << MESSAGES << FAILS;
  std::ofstream(folder.path / "all/plain.toml") << MESSAGES;
  std::ofstream(folder.path / "all/model.toml") << "base = \"t805-25\"\nname = \"mine\"\n";
  const auto done = tlab(folder.path, {"verify", "all", "-o", "out"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_LT(done.out.find("all/b.toml: 3 point(s)"), done.out.find("all/deep/a.toml"));
  EXPECT_TRUE(contains(done.out, "all/plain.toml: no checks, skipped")) << done.out;
  EXPECT_TRUE(contains(done.out, "all/model.toml: no checks, skipped")) << done.out;
  EXPECT_TRUE(done.out.ends_with("1 check(s) hold, 1 do not\n")) << done.out;
  EXPECT_TRUE(fs::exists(folder.path / "out/b/results.csv"));
  EXPECT_TRUE(fs::exists(folder.path / "out/deep/a/results.csv"));
}

TEST(ExperimentsVerify, WithoutAnyCheckItEndsWithOneAndSaysWhere) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path / "none");
  std::ofstream(folder.path / "e.toml") << MESSAGES << HOLDS;
  std::ofstream(folder.path / "plain.toml") << MESSAGES;
  std::ofstream(folder.path / "none/plain.toml") << MESSAGES;
  for (const std::vector<std::string>& paths :
       {std::vector<std::string>{"plain.toml"}, {"none"}, {"e.toml", "none"}}) {
    auto arguments = paths;
    arguments.insert(arguments.begin(), "verify");
    const auto done = tlab(folder.path, arguments);
    EXPECT_EQ(done.exit_code, 1) << done.out;
    EXPECT_TRUE(contains(done.err, paths.back() + ": found no [[check]], expected at least one"))
        << done.err;
  }
}

TEST(ExperimentsVerify, OfManyPointsTheWorstAreShown) {
  const TemporaryFolder folder;
  std::string bytes = "1";
  for (int i = 2; i <= 25; ++i) bytes += ", " + std::to_string(i);
  std::ofstream(folder.path / "e.toml") << MESSAGES << HOLDS;
  const auto lines = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"verify", "e.toml", "--set", "sweep.bytes=[" + bytes + "]"});
    const auto out = tlab(folder.path, more).out;
    return std::ranges::count(out, '\n');
  };
  // without --all, 10 of the 25 rows are shown, and one line mentions the rest
  EXPECT_EQ(lines({"--all"}) - lines({}), 25 - 10 - 1);
}

// The columns are not known before there are results. So the first point is simulated, and its
// record is kept.
TEST(ExperimentsVerify, MistakesAreFoundBeforeResultsAreWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "name.toml")
      << MESSAGES << "[[check]]\nname = \"c\"\nof = \"latency_s\"\n"
      << "within = 1\nformula = \"byte\"\n";
  std::ofstream(folder.path / "cut.toml") << "[[check\n";
  fs::create_directory(folder.path / "none");
  const auto has_results = [&] {
    return fs::exists(folder.path / "results/name/results.csv") ||
           fs::exists(folder.path / "results/name/run.json");
  };
  for (const auto& [path, message] : std::vector<std::pair<std::string, std::string>>{
           {"name.toml",
            "name.toml:7: check \"c\": formula: unknown variable \"byte\", the nearest is"
            " \"bytes\""},
           {"cut.toml", "cut.toml:1"},
           {"missing.toml", "missing.toml"},
           {"none", "no experiment file"}}) {
    const auto done = tlab(folder.path, {"verify", path});
    EXPECT_EQ(done.exit_code, 2) << path;
    EXPECT_TRUE(contains(done.err, message)) << path << done.err;
    EXPECT_FALSE(has_results()) << path;
  }
  EXPECT_EQ(tlab(folder.path, {"run", "name.toml"}).exit_code, 2);
  EXPECT_FALSE(has_results());
}

}  // namespace
}  // namespace laboratory

// Programs with choices as parameters, several rows for each point, and notes.
#include <fstream>

#include "base/errors.hpp"
#include "experiments/laboratory/judge/check_results.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "tests/laboratory/support/load.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;

const std::string MINIMAL = "[program]\nname = \"census\"\n";

TEST(ExperimentsChoices, AreTextsInTheFile) {
  EXPECT_EQ(show_value(load(MINIMAL).points[0].experiment, "pairs"), "all");
  EXPECT_EQ(show_value(load(MINIMAL + "pairs = \"root\"\n").points[0].experiment, "pairs"), "root");
  EXPECT_EQ(show_value(load(MINIMAL, {"program.pairs=root"}).points[0].experiment, "pairs"),
            "root");
  const auto file = load(MINIMAL + "[sweep]\npairs = [\"root\", \"all\"]\n");
  ASSERT_EQ(file.points.size(), 2u);
  EXPECT_EQ(show_value(file.points[0].experiment, "pairs"), "root");
  EXPECT_EQ(show_value(file.points[1].experiment, "pairs"), "all");
  for (const auto& [value, found] :
       {std::pair("\"rot\"", "found 'rot', expected one of all, root (did you mean \"root\"?)"),
        {"1", "found 1, expected one of all, root"},
        {"\"\"", "found '', expected one of all, root"}}) {
    const auto told = message_of<base::BadInput>(
        [&, value = value] { load(MINIMAL + "pairs = " + value + "\n"); });
    EXPECT_NE(told.find(std::string("e.toml:3: program.pairs: ") + found), std::string::npos)
        << told;
  }
}

// Three processors in a line or a ring, with the parameter `pairs` = all or root: four points with
// three rows each.
struct Parts : Sweep {
  Parts() {
    std::ofstream(folder.path / "ref.csv")
        << "pairs,topology,processor,routes_through\nall,line:3,1,2\nroot,line:3,1,2\n"
           "all,ring:3,1,0\nall,line:3,2,0\n";
    std::ofstream(folder.path / "e.toml")
        << MINIMAL << "[sweep]\npairs = [\"all\", \"root\"]\ntopology = [\"line:3\", \"ring:3\"]\n"
        << "[let]\nmiddle = \"{routes_through @ processor = 1}\"\n"
        << "[[check]]\nname = \"line\"\nof = \"routes_through\"\nwithin_abs = 0\n"
        << "formula = \"processor == 1 ? 2 : 0\"\nwhere = \"topology_is_line_3\"\n"
        << "[[check]]\nname = \"reference\"\nof = \"routes_through\"\nwithin_abs = 0\n"
        << "reference = \"ref.csv\"\nkeys = [\"pairs\", \"topology\", \"processor\"]\n"
        << "[[check]]\nname = \"middle\"\nof = \"middle\"\nwithin_abs = 0\n"
        << "formula = \"2\"\nwhere = \"topology_is_line_3 && pairs_is_all\"\n"
        << "[[plot]]\nname = \"p\"\nx = \"processor\"\ny = \"routes_through\"\n"
        << "[[best]]\nname = \"b\"\nof = \"routes_through\"\nover = [\"topology\"]\n"
        << "least = true\n";
  }
};

TEST_F(Parts, RowsFollowTheAxesOfTheirPoint) {
  const auto done = run({"-o", "r"});
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "ok       line: routes_through at 6 point(s)")) << done.out;
  EXPECT_TRUE(contains(done.out, "ok       reference: routes_through at 4 point(s)")) << done.out;
  EXPECT_TRUE(contains(done.out, "ok       middle: middle at 3 point(s)")) << done.out;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"pairs", "topology", "processor", "processors",
                                      "routes_through", "lower_neighbours", "ended"}));
  ASSERT_EQ(table.rows.size(), 12u);
  EXPECT_EQ(table.rows[4], (std::vector<Value>{"all", "ring:3", std::int64_t{1}, std::int64_t{3},
                                               std::int64_t{0}, std::int64_t{1}, "done"}));
  EXPECT_EQ(table.rows[7][0], Value("root"));
  const auto best = parse_csv(read_file(folder.path / "r/best.csv"), "best");
  EXPECT_EQ(best.rows.size(), 6u) << "for each of pairs and processor";
  const auto record = ordered_json::parse(read_file(folder.path / "r/run.json"));
  EXPECT_EQ(record["points"].size(), 4u);
  EXPECT_EQ(record["points"][1]["at"], (ordered_json{{"pairs", "all"}, {"topology", "ring:3"}}));
  EXPECT_EQ(record["points"][0]["notes"], (ordered_json{"most routes pass through p1: 2 of 6"}));
}

TEST_F(Parts, PointsOneByOneGiveTheSameResults) {
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  for (const char* points : {"2", "0-1", "3"})
    ASSERT_EQ(run({"-o", "s", "--point", points}).exit_code, 0);
  const auto merged = tlab(folder.path, {"merge", "s"});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  auto expected = visible("r"), found = visible("s");
  // the page contains the name of the folder
  for (auto* files : {&expected, &found}) files->erase("report.html");
  EXPECT_EQ(expected, found);
  ASSERT_EQ(tlab(folder.path, {"report", "s"}).exit_code, 0);
  EXPECT_EQ(read_file(folder.path / "s/results.csv"), read_file(folder.path / "r/results.csv"));
}

TEST_F(Parts, NotesNameTheirPoint) {
  const auto done = run({"-o", "r"});
  EXPECT_TRUE(contains(
      done.out, "note: pairs = 'root', topology = 'line:3': most routes pass through p1: 2 of 4\n"))
      << done.out;
  EXPECT_TRUE(
      contains(read_file(folder.path / "r/report.html"), "most routes pass through p1: 2 of 4"));
  const auto one =
      run({"-o", "one", "--set", "sweep.pairs=[\"all\"]", "--set", "sweep.topology=[\"line:3\"]"});
  EXPECT_TRUE(contains(one.out, "note: most routes pass through p1: 2 of 6\n")) << one.out;
  std::string many;
  for (int n = 2; n < 24; ++n) many += fmt::format("{}, ", n);
  const auto all = run({"-o", "all", "--set", "sweep={workers=[" + many + "24]}", "--set",
                        "network.topology=line", "--set", "check=[]", "--set", "best=[]"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_TRUE(contains(all.out, "note: workers = 22: ")) << all.out;
  EXPECT_FALSE(contains(all.out, "note: workers = 23: ")) << all.out;
  EXPECT_TRUE(contains(all.out, "\n...\n")) << all.out;
}

// The second of three points failed, and the third was ended early.
TEST(ExperimentsParts, APointWithoutRowsKeepsOneWithoutParts) {
  const auto file =
      load(MINIMAL + "[sweep]\nworkers = [2, 3, 4]\n[network]\ntopology = \"line\"\n" +
           "[[check]]\nname = \"c\"\nof = \"routes_through\"\nwithin_abs = 0\n"
           "formula = \"{routes_through @ processor = 0, processors = 2}\"\n");
  const auto make = [](int processors, const std::string& ended) {
    PointResult result;
    result.topology = fmt::format("line:{}", processors);
    result.processors = processors;
    result.ended = ended;
    return result;
  };
  Results results{make(2, "done"), make(3, "failed"), make(4, "limit")};
  for (const std::int64_t processor : {0, 1})
    results[0].rows.push_back({{"processor", processor}, {"routes_through", std::int64_t{7}}});
  const Table table = make_table(file, results);
  EXPECT_EQ(table.axes, 2u);
  EXPECT_EQ(table.points, (std::vector<std::size_t>{0, 0, 1, 2}));
  EXPECT_EQ(table.point_of(2), 1u);
  EXPECT_EQ(table.row_of(1), 2u);
  EXPECT_EQ(table.count_points(), 3u);
  EXPECT_EQ(table.rows[2], (std::vector<Value>{std::int64_t{3}, {}, "line", "all", {}, "failed"}));
  const auto checks = eval_checks(plan_checks(file), file, table);
  EXPECT_EQ(checks.at(0).points.size(), 2u);
  EXPECT_EQ(checks.at(0).verdict, Verdict::holds);
}

}  // namespace
}  // namespace laboratory

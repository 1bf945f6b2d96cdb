// Checks: results compared with formulas, reference tables and bounds.
#include <fstream>

#include "base/errors.hpp"
#include "experiments/laboratory/judge/check_results.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

// Three points with given results, which no program has simulated.
struct ChecksCase {
  TemporaryFolder folder;
  ExperimentFile file;
  Table table{.columns = {"topology", "bytes", "latency_s", "note"},
              .axes = 2,
              .rows = {{"line", std::int64_t{1}, 1.0, "a"},
                       {"mesh:2x2", std::int64_t{2}, 2.2, "b"},
                       {"line", std::int64_t{4}, 4.0, {}}}};

  explicit ChecksCase(const std::string& checks, const std::vector<std::string>& overrides = {}) {
    std::ofstream(folder.path / "ref.csv")
        << "# published\nbytes,latency_s,other\n1,1.0,5\n2,2.0,\n4,,5\n8,8.0,5\n";
    std::ofstream(folder.path / "words.csv") << "bytes,latency_s\n1,fast\n";
    std::ofstream(folder.path / "nan.csv") << "bytes,latency_s\n1,1.0\n2,nan\n";
    std::ofstream(folder.path / "e.toml")
        << "[program]\nname = \"message\"\n[sweep]\nbytes = [1, 2, 4]\n"
        << checks;
    file = load_experiment((folder.path / "e.toml").string(), parse_overrides(overrides));
  }
  std::vector<CheckResult> eval() const { return eval_checks(plan_checks(file), file, table); }
  std::string message() const {
    return message_of<base::BadInput>([&] { eval(); });
  }
};

std::string check(const std::string& rest) {
  return "[[check]]\nname = \"c\"\nof = \"latency_s\"\n" + rest;
}

TEST(ExperimentsChecks, ColumnsThatWereRenamedAreToldByTheirNewName) {
  EXPECT_EQ(suggest_column("hit_local", {"hit_total", "local"}), ", the nearest is \"local\"");
  EXPECT_EQ(suggest_column("messages", {"message", "messages_sent"}),
            ", the nearest is \"messages_sent\"");
  EXPECT_EQ(suggest_column("hit_local", {"hit_total", "time_s"}), ", the nearest is \"hit_total\"");
  EXPECT_NE(ChecksCase("[[check]]\nname = \"c\"\nof = \"latenzy_s\"\nat_least = 0\n")
                .message()
                .find("latency_s"),
            std::string::npos);
}

TEST(ExperimentsChecks, RelativeErrorsDecide) {
  const std::string formula = "formula = \"bytes\"\n";
  for (const auto& [limit, verdict] : std::vector<std::pair<std::string, Verdict>>{
           {"within = 0.11\n", Verdict::holds},
           {"within = 0.09\n", Verdict::fails},
           {"within_mean = 0.034\n", Verdict::holds},
           {"within = 0.11\nwithin_mean = 0.03\n", Verdict::fails},
           {"within_abs = 0.21\n", Verdict::holds},
           {"within_abs = 0.19\n", Verdict::fails},
           {"within = 0.01\nwhere = \"topology_is_line\"\n", Verdict::holds},
           {"within = 0.01\nwhere = \"topology_is_mesh_2x2\"\n", Verdict::fails},
           {"within = 1\nwhere = \"topology_is_ring\"\n", Verdict::fails},
           {"within = 1\nwhere = \"topology_is_ring\"\nmay_be_empty = true\n", Verdict::holds},
           {"within = 0.01\nmay_be_empty = true\n", Verdict::fails}}) {
    const ChecksCase test(check(formula + limit));
    EXPECT_EQ(test.eval().at(0).verdict, verdict) << limit;
  }
}

TEST(ExperimentsChecks, EveryPointIsCompared) {
  const auto result = ChecksCase(check("formula = \"bytes\"\nwithin = 0.01\n")).eval().at(0);
  ASSERT_EQ(result.points.size(), 3u);
  EXPECT_EQ(result.worst, 1u);
  EXPECT_NEAR(result.points[1].error, 0.1, 1e-12);
  EXPECT_NEAR(result.mean, 0.1 / 3, 1e-12);
  EXPECT_TRUE(result.points[0].holds);
  EXPECT_FALSE(result.points[1].holds);
}

// latency_s is 1, 2.2 and 4; bytes is 1, 2 and 4.
TEST(ExperimentsChecks, BoundsDecide) {
  for (const auto& [bounds, verdict] : std::vector<std::pair<std::string, Verdict>>{
           {"at_least = 1", Verdict::holds},
           {"at_least = 1.01", Verdict::fails},
           {"at_most = 4", Verdict::holds},
           {"at_most = 3.99", Verdict::fails},
           {"between = [1, 4.0]", Verdict::holds},
           {"between = [1.01, 4]", Verdict::fails},
           {"between = [1, 3.99]", Verdict::fails},
           {"between = [\"bytes\", \"1.1 * bytes\"]", Verdict::holds},
           {"at_least = \"1.01 * bytes\"", Verdict::fails},
           {"at_least = 2\nwhere = \"bytes > 1\"", Verdict::holds},
           {"at_least = \"0 / 0\"", Verdict::fails},
           {"between = [\"0 / 0\", 9]", Verdict::fails},
           {"between = [0, \"0 / 0\"]", Verdict::fails},
           {"at_least = \"{latency_s @ bytes = 3}\"", Verdict::fails},
           {"at_least = \"{latency_s @ bytes = 3}\"\nmay_be_empty = true", Verdict::holds}}) {
    const ChecksCase test(check(bounds + "\n"));
    EXPECT_EQ(test.eval().at(0).verdict, verdict) << bounds;
  }
  ChecksCase infinite(check("at_least = 1\n"));
  infinite.table.rows[1][2] = INFINITY;
  EXPECT_EQ(infinite.eval().at(0).verdict, Verdict::fails);
}

TEST(ExperimentsChecks, OfBoundsTheNearestIsShownAndHowFarAValueIsBeyondIt) {
  const ChecksCase test(check("between = [1.5, \"bytes + 0.5\"]\n"));
  const auto result = test.eval().at(0);
  ASSERT_EQ(result.points.size(), 3u);
  const auto expect = [&](std::size_t i, double bound, double error, Kind kind) {
    EXPECT_EQ(result.points[i].expected, bound) << i;
    EXPECT_EQ(result.points[i].error, error) << i;
    EXPECT_EQ(result.points[i].kind, kind) << i;
  };
  expect(0, 1.5, -0.5, Kind::at_least);
  expect(1, 2.5, 0, Kind::at_most);
  expect(2, 4.5, 0, Kind::at_most);
  EXPECT_EQ(
      summarize(result, test.table),
      "FAILED   c: latency_s at 3 point(s), worst 1 (between 1.5 and bytes + 0.5) at topology "
      "= line, bytes = 1");
  const auto shown = make_check_table(result, test.table, 3);
  EXPECT_EQ(shown.columns, (std::vector<std::string>{"topology", "bytes", "simulated", "bound",
                                                     "error", "kind", "mark"}));
  EXPECT_EQ(shown.rows.at(0).back(), Value("fails, worst"));
  const auto csv = make_checks_csv({result}, test.table);
  EXPECT_EQ(csv.rows.at(0).back(), Value("at_least"));
}

TEST(ExperimentsChecks, WithinABoundThePointThatIsNearestToItIsTheWorst) {
  const ChecksCase test(check("at_least = 0.5\n"));
  const auto result = test.eval().at(0);
  EXPECT_EQ(result.worst, 0u);
  EXPECT_EQ(summarize(result, test.table),
            "ok       c: latency_s at 3 point(s), worst 1 (at least 0.5) at topology = line, bytes "
            "= 1");
  const auto shown = make_check_table(result, test.table, 2);  // the worst point is the first row
  EXPECT_EQ(shown.columns, (std::vector<std::string>{"topology", "bytes", "simulated", "at least",
                                                     "error", "mark"}));
  EXPECT_EQ(shown.rows.at(0).back(), Value("worst"));
  EXPECT_EQ(shown.rows.at(1)[1], Value(std::int64_t{2}));
}

TEST(ExperimentsChecks, WhatIsNoNumberFails) {
  for (const char* formula : {"0 / 0", "1 / 0"}) {
    ChecksCase test(check("formula = \"" + std::string(formula) + "\"\nwithin = 1e9\n"));
    const auto result = test.eval().at(0);
    EXPECT_EQ(result.verdict, Verdict::fails) << formula;
    EXPECT_NE(summarize(result, test.table).find("not a number (simulated 1, expected "),
              std::string::npos)
        << summarize(result, test.table);
  }
}

TEST(ExperimentsChecks, DefinitionsMayNeedOthersInAnyOrder) {
  const ChecksCase test(check("formula = \"a\"\nwithin_abs = 1e9\n") +
                        "[let]\na = \"b + c\"\nb = \"c * bytes\"\nc = 2\n");
  const auto result = test.eval().at(0);
  EXPECT_EQ(result.points.at(0).expected, 4);
  EXPECT_EQ(result.points.at(2).expected, 10);
}

TEST(ExperimentsChecks, FormulasNameColumnsKeysAndTheModel) {
  const ChecksCase test(
      "[model.link]\none_way_rate = 1000\n" +
      check("formula = \"bytes + 0 * sweepless\"\nwithin_abs = 1e9\n") +
      "[let]\nsweepless = \"program.bytes + link.one_way_rate / 1000 + cpu.clock\"\n");
  EXPECT_EQ(test.eval().at(0).points.at(2).expected, 4);
}

TEST(ExperimentsChecks, ReferencesAreMatchedByTheirKeys) {
  const ChecksCase test(check("reference = \"ref.csv\"\nkeys = [\"bytes\"]\nwithin = 0.2\n"));
  const auto result = test.eval().at(0);
  EXPECT_EQ(result.verdict, Verdict::holds);
  ASSERT_EQ(result.points.size(), 2u);  // the point with the empty cell does not count
  EXPECT_EQ(result.points[1].expected, 2);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("1 row(s)"), std::string::npos);
  EXPECT_NE(result.notes[0].find("bytes = 8"), std::string::npos);
  const ChecksCase other(
      check("reference = \"ref.csv\"\nkeys = [\"bytes\"]\ncolumn = \"other\"\n"
            "within = 0.2\n"));
  EXPECT_EQ(other.eval().at(0).verdict, Verdict::fails);
  const ChecksCase none(
      check("reference = \"ref.csv\"\nkeys = [\"bytes\"]\nwhere = \"bytes > 4\"\n"
            "within = 0.2\n"));
  EXPECT_EQ(none.eval().at(0).verdict, Verdict::fails);
}

TEST(ExperimentsChecks, TablesShowPointsAndOfManyTheWorst) {
  const ChecksCase test(check("formula = \"bytes\"\nwithin = 0.01\n"));
  const auto result = test.eval().at(0);
  const auto all = make_check_table(result, test.table, 3);
  EXPECT_EQ(all.columns, (std::vector<std::string>{"topology", "bytes", "simulated", "formula",
                                                   "error %", "mark"}));
  ASSERT_EQ(all.rows.size(), 3u);
  EXPECT_NEAR(as_number(all.rows[1][4]).value(), 10, 1e-9);
  EXPECT_EQ(all.rows[1][5], Value("fails, worst"));
  EXPECT_EQ(make_check_table(result, test.table, 2).rows.at(0), all.rows[1]);
  const auto csv = make_checks_csv({result}, test.table);
  EXPECT_EQ(csv.columns, (std::vector<std::string>{"check", "topology", "bytes", "simulated",
                                                   "expected", "error", "kind"}));
  EXPECT_EQ(csv.rows.size(), 3u);
  EXPECT_TRUE(summarize(result, test.table)
                  .starts_with("FAILED   c: latency_s at 3 point(s), worst error 10 % (within 1 %)"
                               " at topology = mesh:2x2, bytes = 2"));
}

TEST(ExperimentsChecks, ADefinitionCanBeChecked) {
  const ChecksCase test(
      "[let]\ntwice = \"2 * latency_s\"\n[[check]]\nname = \"c\"\nof = \"twice\"\n" +
      std::string("formula = \"2 * bytes\"\nwithin = 0.11\n"));
  const auto result = test.eval().at(0);
  EXPECT_EQ(result.verdict, Verdict::holds);
  EXPECT_EQ(result.points.at(1).simulated, 4.4);
}

TEST(ExperimentsChecks, WhatTheModelWasFittedToIsToldApart) {
  const std::string text = check("formula = \"bytes\"\nwithin = 0.2\nwithin_mean = 0.2\n");
  const ChecksCase test(text + "calibrated = \"bytes != 4\"\n");
  const auto result = test.eval().at(0);
  ASSERT_TRUE(result.predicted);
  EXPECT_EQ(result.predicted->points, 1u);
  EXPECT_EQ(result.predicted->worst, 2u);
  EXPECT_EQ(result.predicted->mean, 0);
  EXPECT_NE(summarize(result, test.table).find("of the 1 predicted alone: mean 0 %, worst 0 %"),
            std::string::npos)
      << summarize(result, test.table);
  const auto shown = make_check_table(result, test.table, 3);
  const auto kind = shown.find("kind");
  ASSERT_TRUE(kind);
  EXPECT_EQ(shown.rows[1][*kind], Value("calibrated"));
  EXPECT_EQ(shown.rows[2][*kind], Value("predicted"));
  const ChecksCase all(text + "calibrated = \"1\"\n");
  EXPECT_FALSE(all.eval().at(0).predicted);
}

TEST(ExperimentsChecks, PointsThatNeedOneThatIsNotThereAreLeftOut) {
  const ChecksCase test(
      check("formula = \"bytes + 0 * {latency_s @ bytes = bytes / 2}\"\nwithin = 1\n"));
  const auto result = test.eval().at(0);
  EXPECT_TRUE(result.points.empty()) << "the topologies differ";
  EXPECT_EQ(result.verdict, Verdict::fails);
  EXPECT_EQ(summarize(result, test.table),
            "FAILED   c: latency_s at no point, expected at least one, or may_be_empty = true");
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("3 point(s) left out"), std::string::npos);
  EXPECT_NE(result.notes[0].find("topology = mesh:2x2, bytes = 2"), std::string::npos);
}

// Some points are missing, and the check may be for just these points. The check therefore neither
// holds nor fails.
TEST(ExperimentsChecks, WithoutPointsACheckOfIncompleteResultsIsOpen) {
  for (const auto* rest : {"", "may_be_empty = true\n"}) {
    ChecksCase test(check("at_least = 1\nwhere = \"bytes > 2\"\n" + std::string(rest)));
    test.table.columns.push_back("ended");
    for (auto& row : test.table.rows) row.emplace_back("done");
    test.table.rows[2].back() = "time limit";
    EXPECT_EQ(test.eval().at(0).verdict, Verdict::unmatched);
  }
}

TEST(ExperimentsChecks, NamesOfFilesCanBeCompared) {
  for (const auto& [file, name] : std::vector<std::pair<std::string, std::string>>{
           {"net.dot", "topology_is_net_dot"},
           {"net.dot", "topology_is_net.dot"},
           {"./my nets/a-1.graphml", "topology_is___my_nets_a_1_graphml"},
           {"K\xc3\xb6ln.gv", "topology_is_K__ln_gv"}}) {
    ChecksCase test(check("between = [2, 2.5]\nwhere = \"" + name + "\"\n"));
    test.table.rows[1][0] = file;
    const auto result = test.eval().at(0);
    ASSERT_EQ(result.points.size(), 1u) << name;
    EXPECT_EQ(result.points[0].row, 1u);
    EXPECT_EQ(note_unknown_texts(plan_checks(test.file), test.table), std::vector<std::string>{});
  }
}

TEST(ExperimentsChecks, ComparisonsThatAreNeverOrOftenTrueAreNoted) {
  const auto notes = [](const std::string& name, const char* other) {
    ChecksCase test(check("at_least = 0\nwhere = \"" + name + "\"\n"));
    test.table.rows[2][0] = other;
    return note_unknown_texts(plan_checks(test.file), test.table);
  };
  EXPECT_EQ(notes("topology_is_line", "ring"), std::vector<std::string>{});
  const auto unknown = notes("topology_is_lime", "ring").at(0);
  EXPECT_NE(unknown.find("topology_is_lime: found no point with this topology"), std::string::npos);
  EXPECT_TRUE(unknown.ends_with(", the nearest is \"topology_is_line\"")) << unknown;
  const auto twice = notes("topology_is_mesh_2x2", "mesh-2x2").at(0);
  EXPECT_NE(twice.find("this name matches several texts: mesh-2x2, mesh:2x2"), std::string::npos)
      << twice;
}

// If a formula needs an empty cell, directly or through [let], its point does not count. The other
// points do.
TEST(ExperimentsChecks, EmptyCellsLeavePointsOut) {
  const std::string let = "[let]\ntwice = \"2 * latency_s\"\n";
  for (const auto& [rest, points] : std::vector<std::pair<std::string, std::size_t>>{
           {"of = \"latency_s\"\nat_least = 0", 2},
           {"of = \"twice\"\nat_least = 0", 2},
           {"of = \"bytes\"\nat_least = \"0 * latency_s\"", 2},
           {"of = \"bytes\"\nformula = \"bytes + 0 * twice\"\nwithin = 1", 2},
           {"of = \"bytes\"\nat_least = 0\nwhere = \"latency_s\"", 2},
           {"of = \"bytes\"\nat_least = 0\nwhere = \"latency_s > 0 || bytes > 1\"", 3},
           {"of = \"bytes\"\nformula = \"bytes == 2 ? 2 : bytes + 0 * twice\"\nwithin = 1", 3},
           {"of = \"bytes\"\nat_least = \"{latency_s @ bytes = bytes}\"", 2},
           {"of = \"bytes\"\nat_least = 0\nwhere = \"note_is_a\"", 1}}) {
    ChecksCase test(let + "[[check]]\nname = \"c\"\n" + rest + "\n");
    test.table.rows[1][2] = Value();
    const auto result = test.eval().at(0);
    EXPECT_EQ(result.points.size(), points) << rest;
    EXPECT_EQ(result.verdict, points > 0 ? Verdict::holds : Verdict::fails) << rest;
  }
}

TEST(ExperimentsChecks, TextsThatNoPointHasAreNoted) {
  const auto notes = [](const std::string& reference) {
    const ChecksCase test(check("formula = \"" + reference + "\"\nwithin = 1\n"));
    return note_unknown_texts(plan_checks(test.file), test.table);
  };
  EXPECT_EQ(notes("{latency_s @ topology = mesh:2x2} + {latency_s @ topology = 'line'}"),
            std::vector<std::string>{});
  EXPECT_EQ(notes("{latency_s @ bytes = 3}"), std::vector<std::string>{}) << "a number";
  const auto found = notes("{latency_s @ topology = lin}");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].ends_with(
      "{latency_s @ topology = lin}: found no point with topology = lin, the nearest is \"line\""))
      << found[0];
}

TEST(ExperimentsChecks, EmptyCellsAreLeftOut) {
  ChecksCase test(check("formula = \"bytes\"\nwithin = 0.01\n"));
  test.table.rows[1][2] = {};
  const auto result = test.eval().at(0);
  EXPECT_EQ(result.verdict, Verdict::holds);
  EXPECT_EQ(result.points.size(), 2u);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("1 point(s) left out"), std::string::npos);
}

TEST(ExperimentsChecks, MistakesAreNamed) {
  const std::string good = "formula = \"bytes\"\n", in = "within = 1\n";
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {check(good), "e.toml:5: check \"c\": expected a tolerance"},
           {check(in),
            "check \"c\": found none, expected either a formula or a reference, or "
            "at_least, at_most or between"},
           {check(good + "at_least = 1\n"), "check \"c\": found formula and at_least, expected"},
           {check("at_least = 1\nat_most = 2\n"), "found at_least and at_most, expected"},
           {check("between = [1, 2]\nat_most = 2\n"), "found at_most and between, expected"},
           {check("reference = \"ref.csv\"\nkeys = [\"bytes\"]\nbetween = [1, 2]\n"),
            "found reference and between, expected"},
           {check("at_most = 1\n" + in), "found at_most and within, expected no tolerance"},
           {check("at_most = 1\ncalibrated = \"1\"\n"), "found at_most and calibrated, expected"},
           {check("between = [2, 1]\n"), "e.toml:8: between: found [ 2, 1 ], expected [lowest, h"},
           {check("between = [1]\n"), "between: found [ 1 ], expected [lowest, highest]"},
           {check("at_least = true\n"),
            "e.toml:8: at_least: found true, expected a finite number, or"},
           {check("at_least = nan\n"), "at_least: found nan, expected a finite number, or"},
           {check("at_least = \"byte\"\n"), "check \"c\": at_least: unknown variable \"byte\""},
           {check("at_most = \"1 +\"\n"), "check \"c\": at_most: found \"1 +\""},
           {check(good + in + "within_abs = 1\n"), "expected only one kind"},
           {check(good + in + "keys = [\"bytes\"]\n"), "expected keys"},
           {check(good + in + "column = \"x\"\n"), "found a column without a reference"},
           {check(good + "within = -1\n"), "e.toml:9: within: found -1, expected a number from 0"},
           {check(good + in + "covers = -0.1\n"), "found -0.1, expected a number from 0 to 1"},
           {check(good + in + "covers = 1.1\n"), "found 1.1, expected a number from 0 to 1"},
           {check(good + "wihtin = 1\n"), "e.toml:9: unknown key \"wihtin\", the nearest valid"},
           {"[[check]]\nname = \"c\"\n" + good + in, "\"of\" is missing"},
           {"[[check]]\nof = \"x\"\n" + good + in, "\"name\" is missing"},
           {"[[check]]\nname = \"c\"\nof = \"latency\"\n" + good + in,
            "check \"c\": of: unknown column \"latency\" of the results, the nearest is "
            "\"latency_s\""},
           {"[[check]]\nname = \"c\"\nof = \"topology\"\n" + good + in,
            "of: found topology, which is a text, expected a column of numbers"},
           {check("formula = \"byte\"\n" + in),
            "check \"c\": formula: unknown variable \"byte\", the nearest is \"bytes\""},
           {check("formula = \"cpu.clok\"\n" + in), "the nearest is \"cpu.clock\""},
           {check("formula = \"topology\"\n" + in),
            "found topology, which is a text, expected a comparison"},
           {check(good + in + "where = \"a +\"\n"), "check \"c\": where: found \"a +\""},
           {check(good + in) + "[let]\na = \"b\"\nb = \"a\"\n",
            "let.a: found a needs b needs a, expected definitions without a cycle"},
           {check(good + in) + "[let]\nbytes = 3\n", "found bytes twice"},
           {check(good + in) + "[let]\n\"a b\" = 3\n", "expected a name of letters"},
           {check(good + in) + "[let]\na = true\n",
            "let.a: found true, expected a finite number, or"},
           {check(good + in) + "[let]\na = \"nothing + 1\"\n", "let.a: unknown variable"},
           {check("reference = \"no.csv\"\nkeys = [\"bytes\"]\n" + in), "no.csv: cannot be read"},
           {check("reference = \"ref.csv\"\nkeys = [\"byte\"]\n" + in),
            "keys: unknown column \"byte\" of "},
           {check("reference = \"ref.csv\"\nkeys = [\"bytes\"]\ncolumn = \"x\"\n" + in),
            "column: unknown column \"x\""},
           {check("reference = \"words.csv\"\nkeys = [\"bytes\"]\n" + in),
            "found \"fast\", expected a finite number"},
           {check("reference = \"nan.csv\"\nkeys = [\"bytes\"]\n" + in),
            "nan.csv:3, column latency_s: found \"nan\", expected a finite number or nothing"}}) {
    const auto told = message_of<base::BadInput>([&, text = text] { ChecksCase(text).eval(); });
    EXPECT_NE(told.find(message), std::string::npos) << text << told;
  }
  for (const char* override : {"check=3", "check=[3]", "let=3"})
    EXPECT_NE(message_of<base::BadInput>([&] { ChecksCase("", {override}); }), "") << override;
  EXPECT_TRUE(ChecksCase(check(good + in), {"check=[]"}).eval().empty());
}

}  // namespace
}  // namespace laboratory

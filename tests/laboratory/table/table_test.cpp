#include "experiments/laboratory/table/table.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "base/errors.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {
namespace {

const std::vector<std::string> AWKWARD = {
    "",         " ",       "a,b",  "\"",     "\"\"", "a\nb", "a\r\nb", "\r",
    "#comment", "12",      "-0",   "1e5",    "inf",  "nan",  "0x10",   "1.",
    " lead",    "trail\t", "tree", "1e9999", "ünï",  "true", "+1",     "99999999999999999999"};

Table random_table(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  Table table;
  const std::size_t columns = 1 + below(5);
  for (std::size_t i = 0; i < columns; ++i) {
    std::string name = AWKWARD[below(AWKWARD.size())];
    name += name.empty() || table.find(name) ? "column " + std::to_string(i) : "";
    table.columns.push_back(name);
  }
  const auto rows = below(8);
  for (std::size_t i = 0; i < rows; ++i) {
    auto& row = table.rows.emplace_back();
    while (row.size() < columns) {
      const auto bits = random();
      switch (below(6)) {
        case 0:
          row.emplace_back();
          break;
        case 1:
          row.emplace_back(static_cast<std::int64_t>(bits));
          break;
        case 2:
          row.emplace_back(static_cast<std::int64_t>(bits % 100));
          break;
        case 3:
          row.emplace_back(std::ldexp(double(bits >> 11), int(bits % 2000) - 1060));
          break;
        case 4:
          row.emplace_back(double(bits % 100));
          break;
        default:
          row.emplace_back(AWKWARD[below(AWKWARD.size())]);
      }
    }
  }
  return table;
}

TEST(ExperimentsCsv, RandomTablesComeBackWithTheirTypes) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const auto table = random_table(seed);
    const auto text = to_csv(table);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    const auto back = parse_csv(text, "random.csv");
    ASSERT_EQ(back.columns, table.columns);
    ASSERT_EQ(back.rows, table.rows);
    ASSERT_EQ(to_csv(back), text);
  }
}

TEST(ExperimentsCsv, ExtremeDoublesComeBack) {
  using limits = std::numeric_limits<double>;
  Table table{.columns = {"x"}, .rows = {}};
  for (const double x : {0.0, -0.0, 0.1, 1.0 / 3, 1e22, 1e23, limits::max(), limits::min(),
                         limits::denorm_min(), limits::infinity(), -limits::infinity()})
    table.rows.push_back({x});
  const auto back = parse_csv(to_csv(table), "x.csv");
  EXPECT_EQ(back.rows, table.rows);
  EXPECT_TRUE(std::signbit(std::get<double>(back.rows[1][0])));
  table.rows = {{limits::quiet_NaN()}};
  EXPECT_TRUE(std::isnan(std::get<double>(parse_csv(to_csv(table), "x.csv").rows[0][0])));
}

TEST(ExperimentsCsv, IsWrittenAsExpected) {
  const Table table{.columns = {"topology", "time_s", "note"},
                    .axes = 1,
                    .rows = {{"tree", 0.1, {}}, {"a,\"b\"", 200.0, std::int64_t{3}}}};
  EXPECT_EQ(to_csv(table), "topology,time_s,note\ntree,0.1,\n\"a,\"\"b\"\"\",200.0,3\n");
}

TEST(ExperimentsCsv, ReadsWhatPeopleWrite) {
  const auto table = parse_csv(
      "\xef\xbb\xbf# a comment, \"\r\nworkers, time_s ,name\r\n\r\n1, 2.5,\"x\ny\" \r\n# end\n2,,",
      "a.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"workers", "time_s", "name"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<Value>{std::int64_t{1}, 2.5, "x\ny"}));
  EXPECT_EQ(table.rows[1], (std::vector<Value>{std::int64_t{2}, {}, {}}));
}

TEST(ExperimentsCsv, FormulasOfASpreadsheetAreGuarded) {
  Table table{.columns = {"a", "b"}, .rows = {}};
  for (const char* text : {"=1+1", "+1", "-x", "@f", "\t=1", "a=1", ""})
    table.rows.push_back({std::string(text), -1.5});
  const auto guarded = guard_formulas(table);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& text = std::get<std::string>(table.rows[i][0]);
    EXPECT_EQ(to_string(guarded.rows[i][0]), i < 5 ? "'" + text : text);
    EXPECT_EQ(guarded.rows[i][1], table.rows[i][1]) << "a number is none";
  }
}

TEST(ExperimentsCsv, QuotedNumbersAreNumbersWhereThatIsAsked) {
  const auto table = parse_csv("a\n\"1.5\"\n\" 3 \"\n\"x\"\n\"\"\n2\n", "t.csv");
  const Value expected[] = {1.5, std::int64_t{3}, "x", "", std::int64_t{2}};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    EXPECT_EQ(unquote_number(table.rows[i][0]), expected[i]) << i;
}

TEST(ExperimentsCsv, ErrorsNameTheLine) {
  const auto message = [](std::string_view text) {
    return message_of<base::BadInput>([&] { parse_csv(text, "ref.csv"); });
  };
  EXPECT_EQ(message("a,b\n1,2\n\n1,2,3\n"), "ref.csv:4: 3 cells, expected 2: a,b");
  EXPECT_EQ(message("a,b\n\"x\ny\",1\n7\n"), "ref.csv:4: 1 cells, expected 2: a,b");
  EXPECT_TRUE(message("a\n\"x\n\n").starts_with("ref.csv:2: a quote opened here"));
  EXPECT_TRUE(message("a\n\"x\"y\n").starts_with("ref.csv:2: 'y' after a closing quote"));
  EXPECT_TRUE(message("a\nx\"y\n").starts_with("ref.csv:2: a quote inside the cell x\"y"));
  EXPECT_TRUE(message("# only\n").starts_with("ref.csv:2: no header line"));
  EXPECT_TRUE(message("").starts_with("ref.csv:1: no header line"));
  EXPECT_EQ(message("a,,b\n"), "ref.csv:1: column 2 has no name");
  EXPECT_EQ(message("a,b,a\n"), "ref.csv:1: two columns are named \"a\"");
}

TEST(ExperimentsTable, CellsAsNumbersAndText) {
  EXPECT_EQ(as_number(Value(std::int64_t{3})), 3.0);
  EXPECT_EQ(as_number(Value(0.5)), 0.5);
  EXPECT_EQ(as_number(Value("3")), std::nullopt);
  EXPECT_EQ(as_number(Value()), std::nullopt);
  EXPECT_EQ(to_string(Value(20.0)), "20");
  EXPECT_EQ(to_string(Value(0.1)), "0.1");
  EXPECT_EQ(to_string(Value()), "");
}

TEST(ExperimentsTable, LabelsHaveUnits) {
  EXPECT_EQ(make_label("time_s"), "time [s]");
  EXPECT_EQ(make_label("time_per_ray_ms"), "time per ray [ms]");
  EXPECT_EQ(make_label("speedup"), "speed-up");
  EXPECT_EQ(make_label("link_rate_mbit_s"), "link rate [Mbit/s]");
  EXPECT_EQ(make_label("cpu_busy_worker_mean"), "cpu busy worker mean");
}

TEST(ExperimentsTable, TextIsAligned) {
  const Table table{.columns = {"topology", "workers", "time_s", "note"},
                    .axes = 2,
                    .rows = {{"tree", std::int64_t{1}, 145.91, "größe"},
                             {"hypercube", std::int64_t{16}, 33.7, {}},
                             {"x\ny", std::int64_t{7}, {}, "b"}}};
  EXPECT_EQ(to_text(table),
            "topology   workers  time_s  note\n"
            "---------  -------  ------  -----\n"
            "tree             1   145.9  größe\n"
            "hypercube       16    33.7\n"
            "x?y              7          b\n");
  EXPECT_EQ(to_text(table, {"workers", "topology"}),
            "workers  topology\n"
            "-------  ---------\n"
            "      1  tree\n"
            "     16  hypercube\n"
            "      7  x?y\n");
  EXPECT_EQ(message_of<base::BadInput>([&] { to_text(table, {"time"}); }),
            "no column \"time\" in the table; its columns are topology, workers, time_s, note");
}

TEST(ExperimentsTable, PrecisionSuitsTheColumn) {
  const auto format = [](std::vector<double> numbers) {
    Table table{.columns = {"x"}, .rows = {}};
    for (const double x : numbers) table.rows.push_back({x});
    return format_column(table, 0);
  };
  using Cells = std::vector<std::string>;
  EXPECT_EQ(format({1, 0.61789, 0}), (Cells{"1.000", "0.618", "0.000"}));
  EXPECT_EQ(format({0.9, 0.61789}), (Cells{"0.9000", "0.6179"}));
  EXPECT_EQ(format({12345.6, 100}), (Cells{"12346", "100"}));
  EXPECT_EQ(format({12345.6, 0.00001234}), (Cells{"1.235e+04", "1.234e-05"}));
  EXPECT_EQ(format({0}), (Cells{"0.0"}));
}

}  // namespace
}  // namespace laboratory

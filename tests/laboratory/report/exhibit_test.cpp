// Plots that an experiment declares with [[plot]], made from a table of results.
#include "experiments/laboratory/report/exhibit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "experiments/laboratory/table/laws.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

// Speed-ups by Amdahl's law with the serial fractions 1/20 and 1/5. At 32 workers, the second curve
// is 20 % below the law.
struct LawsCase {
  TemporaryFolder folder;
  ExperimentFile file;
  Table table{
      .columns = {"topology", "workers", "objects", "speedup", "busiest"}, .axes = 3, .rows = {}};

  explicit LawsCase(const std::string& text) {
    std::ofstream(folder.path / "ref.csv") << "objects,workers,s\n200,2,2.0\n200,4,\n800,64,1\n";
    std::ofstream(folder.path / "e.toml")
        << "[sweep]\nobjects = [800, 200]\nworkers = [1, 2, 4, 8, 16, 32]\n"
        << text;
    file = load_experiment((folder.path / "e.toml").string(), {});
    for (const auto& point : file.points) {
      const auto& e = point.experiment;
      const double n = double(e.workers), serial = objects_of(e) == 200 ? 0.05 : 0.2;
      const double s = amdahl_speedup(serial, n);
      table.rows.push_back(
          {"tree", e.workers, objects_of(e), n == 32 && objects_of(e) == 800 ? 0.8 * s : s, "a>b"});
    }
  }

  std::vector<Exhibit> make() {
    const auto plan = plan_checks(file);
    const auto rows = make_rows(plan, file, table);
    check_names(plan, rows, 0);
    return make_exhibits(plan, rows, {}, nothing);
  }
  std::string message() {
    return message_of<base::BadInput>([&] { make(); });
  }
  std::vector<std::string> nothing;
};

std::string plot(const std::string& rest) {
  return "[[plot]]\nname = \"p\"\nx = \"workers\"\ny = \"speedup\"\n" + rest;
}

std::vector<std::string> names(const Plot& plot) {
  std::vector<std::string> names;
  for (const auto& series : plot.series) names.push_back(series.name);
  return names;
}

// A curve's intervals are found by the name of its column.
TEST(ExperimentsExhibits, ACurveKnowsTheColumnThatItShows) {
  const auto shown = LawsCase(plot("")).make();
  ASSERT_FALSE(shown[0].plot.series.empty());
  for (const auto& series : shown[0].plot.series) EXPECT_EQ(series.column, "speedup");
  const auto eval =
      LawsCase("[[plot]]\nname = \"p\"\nx = \"workers\"\ny = \"speedup / workers\"\n").make();
  ASSERT_FALSE(eval[0].plot.series.empty());
  for (const auto& series : eval[0].plot.series) EXPECT_EQ(series.column, "");
}

TEST(ExperimentsExhibits, ACurveForEachValueOfTheOtherAxes) {
  const auto exhibits = LawsCase(plot("")).make();
  ASSERT_EQ(exhibits.size(), 1u);
  const Plot& p = exhibits[0].plot;
  EXPECT_EQ(p.name, "p");
  EXPECT_EQ(p.title, "Speed-up");
  EXPECT_EQ(p.x_label, "workers");
  EXPECT_EQ(names(p), (std::vector<std::string>{"800 objects", "200 objects"}));
  EXPECT_EQ(p.series[1].x, (std::vector<double>{1, 2, 4, 8, 16, 32}));
  EXPECT_TRUE(p.log_x);
  EXPECT_FALSE(p.log_y);
  EXPECT_TRUE(LawsCase(plot("ideal = true\n")).make()[0].plot.log_y) << "or the ideal is no line";
  EXPECT_FALSE(LawsCase(plot("log_x = false\n")).make()[0].plot.log_x);
}

TEST(ExperimentsExhibits, ExpressionsConditionsAndLabels) {
  const auto exhibits =
      LawsCase(plot("where = \"objects == 200 * workers\"\ny_label = \"S [1]\"\n") +
               "[[plot]]\nname = \"q\"\nx = \"objects\"\ny = \"gain - 1\"\n"
               "series = []\nwhere = \"workers == 4\"\n"
               "[let]\ngain = \"speedup / {speedup @ workers = workers / 2}\"\n")
          .make();
  ASSERT_EQ(exhibits.size(), 2u);
  EXPECT_EQ(exhibits[0].plot.series.size(), 1u) << "a diagonal of the sweep";
  EXPECT_EQ(exhibits[0].plot.series[0].x, (std::vector<double>{1, 4}));
  EXPECT_EQ(exhibits[0].plot.y_label, "S [1]");
  EXPECT_EQ(exhibits[0].plot.title, "S");
  EXPECT_EQ(exhibits[1].plot.series.at(0).x, (std::vector<double>{200, 800}));
  EXPECT_NEAR(exhibits[1].plot.series[0].y[0],
              amdahl_speedup(0.05, 4) / amdahl_speedup(0.05, 2) - 1, 1e-12);
}

TEST(ExperimentsExhibits, SeveralYHaveTheirCurvesEach) {
  const auto p = LawsCase(
                     "[[plot]]\nname = \"p\"\nx = \"workers\"\ny = [\"speedup\", \"half_of\"]\n"
                     "[let]\nhalf_of = \"speedup / 2\"\n")
                     .make()
                     .at(0)
                     .plot;
  EXPECT_EQ(names(p), (std::vector<std::string>{"speed-up, 800 objects", "speed-up, 200 objects",
                                                "half of, 800 objects", "half of, 200 objects"}));
  EXPECT_EQ(p.series[2].y.at(0), 0.5);
}

TEST(ExperimentsExhibits, PointsAndPlotsThatCannotBeAreNamed) {
  LawsCase test(plot("where = \"objects == 200 && workers <= 2\"\n") +
                "[[plot]]\nname = \"none\"\nx = \"workers\"\ny = \"{speedup @ workers = 64}\"\n");
  const auto exhibits = test.make();
  EXPECT_EQ(exhibits.size(), 1u);
  ASSERT_EQ(test.nothing.size(), 1u);
  EXPECT_TRUE(test.nothing[0].starts_with("The plot none has no points. 12 point(s) left out"));
}

TEST(ExperimentsExhibits, ReferencesStandBesideWithTheirDifferences) {
  const auto exhibit = LawsCase(plot("reference = \"ref.csv\"\nkeys = [\"objects\", \"workers\"]\n"
                                     "column = \"s\"\nreference_name = \"thesis\"\n"))
                           .make()
                           .at(0);
  EXPECT_EQ(names(exhibit.plot).back(), "200 objects, thesis");
  const Series& thesis = exhibit.plot.series.back();
  EXPECT_EQ(thesis.kind, SeriesKind::reference);
  EXPECT_EQ(thesis.of, 1u);
  EXPECT_EQ(thesis.x, (std::vector<double>{2}));
  ASSERT_EQ(exhibit.plot.differences.size(), 1u);
  EXPECT_NEAR(exhibit.plot.differences[0].y.at(0), 100 * (amdahl_speedup(0.05, 2) / 2 - 1), 1e-9);
  EXPECT_EQ(exhibit.differences.rows.size(), 1u);
  EXPECT_EQ(exhibit.differences.columns[3], "thesis");
  ASSERT_EQ(exhibit.notes.size(), 1u);
  EXPECT_NE(exhibit.notes[0].find("objects = 800, workers = 64"), std::string::npos);
  EXPECT_EQ(exhibit.findings.at(0),
            "Speed-up: 4.8 % from the thesis on average, 4.8 % at worst, for 1 points.");
}

// The efficiencies vary around 1, so that the points do not determine the serial fraction, or
// around 1.5, where the law does not apply.
TEST(ExperimentsExhibits, IntervalsThatSayNothingAreToldSo) {
  for (const auto& [mean, told] : std::vector<std::pair<std::string, std::string>>{
           {"1", ", so the points do not determine it."},
           {"1.5", ", which is not a share of the work: the law does not hold."}}) {
    const auto exhibit =
        LawsCase(
            "[[plot]]\nname = \"p\"\nx = \"workers\"\nwhere = \"objects == 200\"\nfit = "
            "\"gustafson\"\ny = \"workers * (" +
            mean + " + 0.02 * cos(workers))\"\n")
            .make()
            .at(0);
    ASSERT_EQ(exhibit.findings.size(), 1u);
    EXPECT_TRUE(exhibit.findings[0].ends_with(told)) << exhibit.findings[0];
  }
}

TEST(ExperimentsExhibits, LawsAreFittedToEachCurve) {
  const auto exhibits = LawsCase(plot("fit = \"amdahl\"\n") +
                                 "[[plot]]\nname = \"q\"\nx = \"workers\"\ny = \"speedup\"\n"
                                 "fit = \"sun-ni\"\ngrowth = \"1\"\nwhere = \"objects == 200\"\n")
                            .make();
  for (const auto& exhibit : exhibits) {
    const auto& row = exhibit.fits.rows.back();
    EXPECT_EQ(row[2], Value("serial fraction"));
    EXPECT_NEAR(*as_number(row[3]), 0.05, 1e-6);
    const Series& line = exhibit.plot.series.back();
    EXPECT_EQ(line.kind, SeriesKind::law);
    EXPECT_NEAR(line.y.back(), amdahl_speedup(0.05, 32), 1e-4);
  }
  EXPECT_EQ(exhibits[1].plot.series.at(0).key(), "speed-up (s = 0.05)");
  const auto csv = make_fits_csv(exhibits);
  EXPECT_EQ(csv.columns.front(), "plot");
  EXPECT_EQ(csv.rows.size(), 3u);
  EXPECT_EQ(csv.rows.back().front(), Value("q"));
  const auto few = LawsCase(plot("fit = \"amdahl\"\nwhere = \"workers <= 2\"\n")).make().at(0);
  EXPECT_EQ(few.notes.size(), 2u) << "one point says nothing of its own error";
}

// From eight workers on, the speed-up does not grow.
TEST(ExperimentsExhibits, ALawThatDoesNotFitIsTold) {
  auto test = LawsCase(plot("fit = \"amdahl\"\nwhere = \"objects == 200\"\n"));
  std::vector<double> workers, speedups;
  for (auto& row : test.table.rows) {
    row[3] = std::min(5.0, *as_number(row[1]));
    if (row[2] != Value(std::int64_t{200})) continue;
    workers.push_back(*as_number(row[1]));
    speedups.push_back(*as_number(row[3]));
  }
  const auto fit = fit_amdahl(workers, speedups);
  ASSERT_TRUE(fit && fit->misfit);
  const auto told = fmt::format("Amdahl's law does not fit: it deviates by up to {:.2g} %",
                                100 * fit->misfit->deviation);
  const auto exhibit = test.make().at(0);
  ASSERT_EQ(exhibit.findings.size(), 1u);
  EXPECT_NE(exhibit.findings[0].find(told), std::string::npos) << exhibit.findings[0] << told;
}

TEST(ExperimentsExhibits, OnlyACurveThatFallsTurns) {
  auto test = LawsCase(plot("optimum = true\n"));
  const auto exhibit = test.make().at(0);
  EXPECT_EQ(exhibit.optima.rows.at(0).back(), Value("turns down after 16"));
  EXPECT_EQ(exhibit.optima.rows.at(1).back(), Value("still rising at 32"));
  const Series& mark = exhibit.plot.series.back();
  EXPECT_EQ(mark.kind, SeriesKind::mark);
  EXPECT_EQ(mark.x, (std::vector<double>{16}));
  for (auto& row : test.table.rows)
    if (*as_number(row[1]) > 8) row[3] = *as_number(row[1]) == 16 ? 5.02 : 5.0;
  const auto level = test.make().at(0);
  EXPECT_EQ(level.optima.rows.at(1).back(), Value("turns down after 8"));
  for (auto& row : test.table.rows) row[3] = std::min(5.0, *as_number(row[3]));
  EXPECT_EQ(test.make().at(0).optima.rows.at(1).back(), Value("levels off at 8"));
}

TEST(ExperimentsExhibits, MistakesAreNamed) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[[plot]]\nx = \"workers\"\n", "e.toml:4: plot \"\": \"name\" is missing"},
           {"[[plot]]\nname = \"p\"\nx = \"workers\"\n", "plot \"p\": \"y\" is missing"},
           {"[[plot]]\nname = \"../p\"\n", "expected a name without /"},
           {"[[plot]]\nname = \"" + std::string(201, 'p') + "\"\nx = \"workers\"\n",
            "found a name of 201 bytes, expected at most 200"},
           {plot("") + plot(""), "found this name twice"},
           {plot("fitt = 1\n"), "unknown key \"fitt\", the nearest valid key is \"fit\""},
           {plot("fit = \"moore\"\n"), "expected one of amdahl, gustafson, sun-ni, log"},
           {plot("fit = \"sun-ni\"\n"), "expected growth"},
           {plot("growth = \"rays\"\n"), "expected growth"},
           {plot("keys = [\"workers\"]\n"), "expected keys"},
           {plot("column = \"x\"\n"), "expected no column"},
           {"[[plot]]\nname = \"p\"\nx = \"workers\"\ny = [\"speedup\", \"workers\"]\n"
            "reference = \"ref.csv\"\nkeys = [\"workers\"]\ncolumn = \"s\"\n",
            "expected one y with a reference"},
           {plot("reference = \"no.csv\"\nkeys = [\"workers\"]\n"), "no.csv: cannot be read"},
           {plot("series = [\"object\"]\n"),
            "plot \"p\": series: \"object\" is not an axis of the results, the nearest is "
            "\"objects\""},
           {plot("where = \"worker > 1\"\n"), "where: unknown variable \"worker\""},
           {"[[plot]]\nname = \"p\"\nx = \"worker\"\ny = \"speedup\"\n",
            "plot \"p\": x: unknown variable \"worker\", the nearest is \"workers\""},
           {"[[plot]]\nname = \"p\"\nx = \"workers\"\ny = \"busiest\"\n",
            "found busiest, which is a text"},
           {"[report]\nnetworks = \"some\"\n", "expected one of all, largest, none"},
           {"[report]\nnetwork = \"all\"\n", "the nearest valid key is \"networks\""}}) {
    const auto told = message_of<base::BadInput>([&, text = text] { LawsCase(text).make(); });
    EXPECT_NE(told.find(message), std::string::npos) << text << told;
  }
}

}  // namespace
}  // namespace laboratory

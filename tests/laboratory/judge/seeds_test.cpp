// Results for several seeds: their means in tables, [[check]] and [[best]].
#include "base/errors.hpp"
#include "experiments/laboratory/judge/best.hpp"
#include "experiments/laboratory/judge/check_results.hpp"
#include "experiments/laboratory/points/means.hpp"
#include "experiments/laboratory/points/view.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

// Times of two networks for three seeds. The effect of a seed, up to 4, is the same for both
// networks. The mesh takes `gap` longer, with an additional deviation of 0.1.
struct SeedsCase {
  ExperimentFile file;
  Table table{.columns = {"topology", "seed", "time_s", "rays", "ended"}, .axes = 2, .rows = {}};

  SeedsCase(const std::string& rest, double gap) {
    file = load(
        "[program]\nname = \"farm\"\n[sweep]\ntopology = [\"line\", \"mesh:2x2\"]\n"
        "seed = [1, 2, 3]\n" +
        rest);
    for (const auto& topology : {"line", "mesh:2x2"})
      for (const std::int64_t seed : {1, 2, 3}) {
        const bool is_mesh = topology[0] == 'm';
        const double time =
            10 + 2.0 * double(seed - 1) + (is_mesh ? gap + (seed == 2 ? 0.1 : -0.05) : 0);
        table.rows.push_back({topology, seed, time, std::int64_t{5}, "done"});
      }
  }
  CheckPlan plan() const { return plan_checks(file); }
  BestAnswer best() const {
    const auto compiled = plan();
    const auto rows = make_rows(compiled, file, table);
    check_names(compiled, rows, 0);
    return find_best(compiled, rows).at(0);
  }
};

const std::string FASTEST =
    "[[best]]\nname = \"fastest\"\nof = \"time_s\"\nover = [\"topology\"]\n";

TEST(ExperimentsSeeds, ATableOfMeansHasHalfWidths) {
  const auto means = average_seeds(SeedsCase("", 1).table);
  EXPECT_EQ(means.columns, (Texts{"topology", "time_s", "rays", "ended", "seeds", "time_s ±"}));
  EXPECT_EQ(means.axes, 1u);
  ASSERT_EQ(means.rows.size(), 2u);
  EXPECT_EQ(means.points, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(means.rows[0][1], Value(12.0));
  EXPECT_EQ(means.rows[0][2], Value(std::int64_t{5})) << "equal results stay whole numbers";
  EXPECT_EQ(means.rows[0][3], Value("done"));
  EXPECT_EQ(means.rows[0][4], Value(std::int64_t{3}));
  // standard deviation s = 2, and Student's t = 4.303 for 2 degrees of freedom
  EXPECT_NEAR(*as_number(means.rows[0][5]), 4.30265 * 2 / std::sqrt(3), 1e-4);
}

TEST(ExperimentsSeeds, MeansLeaveOutIncompletePoints) {
  auto table = SeedsCase("", 1).table;
  table.rows[1][4] = "limit";
  const auto means = average_seeds(table);
  EXPECT_EQ(means.rows[0][1], Value(12.0)) << "of 10 and 14";
  EXPECT_EQ(means.rows[0][3], Value("limit"));
  EXPECT_EQ(means.rows[0][4], Value(std::int64_t{2}));
}

TEST(ExperimentsSeeds, TheShownTableHasTheHalfWidthBesideTheMean) {
  const SeedsCase seeds("", 1);
  const auto view = choose_view(seeds.file, average_seeds(seeds.table));
  const auto at = std::ranges::find(view.columns, "time_s");
  ASSERT_NE(at, view.columns.end());
  EXPECT_EQ(*std::next(at), "time_s ±");
  EXPECT_EQ(std::ranges::find(view.columns, "seed"), view.columns.end());
}

TEST(ExperimentsSeeds, MeansCsvHasARowForEachResult) {
  const SeedsCase seeds("", 1);
  const auto csv = make_means_csv(seeds.file, seeds.table);
  EXPECT_EQ(csv.columns,
            (Texts{"topology", "result", "samples", "mean", "deviation", "low_95", "high_95"}));
  ASSERT_EQ(csv.rows.size(), 4u) << "two results of two networks";
  EXPECT_EQ(csv.rows[0][1], Value("time_s"));
  EXPECT_NEAR(*as_number(csv.rows[0][4]), 2, 1e-12);
  EXPECT_TRUE(make_means_csv(seeds.file, average_seeds(seeds.table)).rows.empty());
}

// The interval of each mean is ± 5, but that of the difference between pairs is ± 0.2.
TEST(ExperimentsSeeds, TheBestIsFoundByPairs) {
  EXPECT_EQ(SeedsCase(FASTEST, 1).best().best.rows.at(0).at(0), Value("line"));
}

TEST(ExperimentsSeeds, ADifferenceThatMayBeChanceIsATie) {
  const auto answer = SeedsCase(FASTEST, 0.1).best();
  ASSERT_EQ(answer.best.rows.size(), 1u) << "the seed is no case of its own";
  EXPECT_EQ(answer.best.rows[0][0], Value("line or mesh:2x2"));
}

TEST(ExperimentsSeeds, ASeedIsNoAxisOfPlotsAndQuestions) {
  for (const auto& text :
       {std::string("[[best]]\nname = \"b\"\nof = \"time_s\"\nover = [\"seed\"]\n"),
        FASTEST + "for_each = [\"seed\"]\n",
        std::string("[[plot]]\nname = \"p\"\nx = \"seed\"\ny = \"time_s\"\n"),
        std::string("[[plot]]\nname = \"p\"\nx = \"rays\"\ny = \"time_s\"\n"
                    "series = [\"seed\"]\n")}) {
    const auto message = message_of<base::BadInput>([&] { SeedsCase(text, 1).best(); });
    EXPECT_TRUE(contains(message, "found seed, whose values are samples")) << message;
  }
}

// The mean, 12, is within the bound, although the result for the third seed, 14, is not.
TEST(ExperimentsSeeds, ChecksJudgeTheMean) {
  const SeedsCase seeds(
      "[[check]]\nname = \"c\"\nof = \"time_s\"\nat_most = 13\nwhere = \"topology_is_line\"\n", 1);
  const auto results = eval_checks(seeds.plan(), seeds.file, seeds.table);
  ASSERT_EQ(results.at(0).points.size(), 1u);
  const auto& point = results[0].points[0];
  EXPECT_EQ(results[0].verdict, Verdict::holds);
  EXPECT_EQ(point.simulated, 12);
  EXPECT_EQ(point.seeds, 3u);
  EXPECT_NEAR(point.half_width.value(), 4.968, 1e-3);
  EXPECT_EQ(summarize(results[0], seeds.table),
            "ok       c: time_s at 1 point(s), worst 12 ± 5 (at most 13) at topology = line (mean "
            "over 3 seeds)");
}

// The expected value for a seed uses the result for the same seed, so the effect of the seed
// cancels.
TEST(ExperimentsSeeds, ChecksPairTheExpectedValue) {
  const SeedsCase seeds(
      "[[check]]\nname = \"c\"\nof = \"time_s\"\nformula = \"{time_s @ topology = line} + 1\"\n"
      "within = 0.01\nwhere = \"topology_is_mesh_2x2\"\n",
      1);
  const auto results = eval_checks(seeds.plan(), seeds.file, seeds.table);
  const auto& point = results.at(0).points.at(0);
  EXPECT_NEAR(point.error, 0, 1e-12);
  // standard deviation s = 0.0866, relative to 13
  EXPECT_NEAR(point.half_width.value(), 4.30265 * 0.0866 / std::sqrt(3) / 13, 1e-5);
}

}  // namespace
}  // namespace laboratory

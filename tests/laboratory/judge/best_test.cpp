// Tables [[best]]: the best values of some axes for each combination of the other axes.
#include "experiments/laboratory/judge/best.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

// An example in which the mesh is faster than the line from 4 workers on. With more than 8 workers,
// neither network becomes faster.
struct BestCase {
  ExperimentFile file;
  Table table{.columns = {"topology", "workers", "objects", "time_s"}, .axes = 3, .rows = {}};

  explicit BestCase(const std::string& question) {
    file =
        load("[sweep]\ntopology = [\"line\", \"mesh\"]\nworkers = [1, 2, 4, 8, 16]\n" + question);
    for (const auto& point : file.points) {
      const auto& e = point.experiment;
      const double n = double(e.workers);
      const double time = e.topology.text == "line" ? 64 / std::min(n, 2.0) : 64 / std::min(n, 8.0);
      table.rows.push_back({e.topology.text, e.workers, objects_of(e), time});
    }
  }
  BestAnswer find() const {
    const auto plan = plan_checks(file);
    const auto rows = make_rows(plan, file, table);
    check_names(plan, rows, 0);
    return find_best(plan, rows).at(0);
  }
};

const std::string QUESTION = "[[best]]\nname = \"least\"\nof = \"time_s\"\nover = [\"topology\"]\n";

TEST(ExperimentsBest, TheLeastForEachOfTheOthers) {
  const auto answer = BestCase(QUESTION).find();
  EXPECT_EQ(answer.best.columns, (std::vector<std::string>{"workers", "best", "time_s", "runner_up",
                                                           "runner_up_time_s", "better by %"}));
  ASSERT_EQ(answer.best.rows.size(), 5u);
  EXPECT_EQ(answer.best.rows[0][1], Value("line or mesh")) << "no difference";
  EXPECT_EQ(answer.best.rows[0][3], Value());
  EXPECT_EQ(answer.best.rows[2],
            (std::vector<Value>{std::int64_t{4}, "mesh", 16.0, "line", 32.0, 100.0}));
  EXPECT_TRUE(answer.pays.rows.empty());
  EXPECT_EQ(answer.findings,
            (std::vector<std::string>{
                "least: mesh in 3, line or mesh in 2 of 5 cases, by at most 300.0 %."}));
}

TEST(ExperimentsBest, TheMostOfAnExpressionWhere) {
  const auto answer =
      BestCase(
          "[[best]]\nname = \"b\"\nof = \"1 / time_s\"\nleast = false\nover = [\"workers\"]\n"
          "for_each = [\"topology\"]\nwhere = \"workers < 16\"\n")
          .find();
  ASSERT_EQ(answer.best.rows.size(), 2u);
  EXPECT_EQ(answer.best.columns[2], "value");
  EXPECT_EQ(answer.best.rows[0][1], Value("2 workers or 4 workers or 8 workers"));
  EXPECT_EQ(answer.best.rows[1][1], Value("8 workers"));
}

TEST(ExperimentsBest, DoublingPaysUntilItDoesNot) {
  const auto answer = BestCase(QUESTION + "pays = \"workers\"\ngain = 0.5\n").find();
  EXPECT_EQ(answer.pays.columns,
            (std::vector<std::string>{"topology", "pays_up_to_workers", "next doubling gains %"}));
  EXPECT_EQ(answer.pays.rows.at(0), (std::vector<Value>{"line", std::int64_t{2}, 0.0}));
  EXPECT_EQ(answer.pays.rows.at(1), (std::vector<Value>{"mesh", std::int64_t{8}, 0.0}));
  const auto some =
      BestCase(QUESTION + "pays = \"workers\"\nwhere = \"workers != 2 && workers < 16\"\n").find();
  // From 1 to 4 workers, the line gains a factor of 2 in two doublings, which is 41 % for each.
  EXPECT_EQ(some.pays.rows.at(0)[1], Value(std::int64_t{4}));
  EXPECT_EQ(some.pays.rows.at(1), (std::vector<Value>{"mesh", std::int64_t{8}, {}}))
      << "to the end";
  EXPECT_EQ(some.findings.back(), "mesh: doubling workers pays up to 8, the largest value tried.");
  const auto both = BestCase(QUESTION + "pays = \"workers\"\nwhere = \"workers < 4\"\n").find();
  EXPECT_EQ(both.findings.back(),
            "line; mesh: doubling workers pays up to 2, the largest value tried.");
  const auto least =
      BestCase(QUESTION + "pays = \"workers\"\ngain = 0.5\nwhere = \"workers != 2\"\n").find();
  EXPECT_EQ(least.pays.rows.at(0)[1], Value(std::int64_t{1}));
  EXPECT_NEAR(*as_number(least.pays.rows.at(0)[2]), 100 * (std::sqrt(2) - 1), 0.05);
  const auto csv = make_pays_csv({answer});
  EXPECT_EQ(csv.rows.at(1), (std::vector<Value>{"least", "topology = mesh", std::int64_t{8}, 0.0}));
  EXPECT_EQ(make_best_csv({answer}).rows.size(), 5u);
}

TEST(ExperimentsBest, MistakesAreNamed) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[[best]]\nof = \"time_s\"\n", "\"name\" is missing"},
           {"[[best]]\nname = \"b\"\nof = \"time_s\"\n", "best \"b\": \"over\" is missing"},
           {QUESTION + "for_each = [\"topology\"]\n", "expected different axes"},
           {QUESTION + "pays = \"worker\"\n",
            "best \"least\": pays: \"worker\" is not an axis of the results, the nearest is "
            "\"workers\""},
           {QUESTION + "gain = 2\n", "gain: found 2, expected a number from 0 to 1"},
           {"[[best]]\nname = \"b\"\nof = \"time\"\nover = [\"topology\"]\n",
            "of: unknown variable \"time\""}}) {
    const auto told = message_of<base::BadInput>([&, text = text] { BestCase(text).find(); });
    EXPECT_NE(told.find(message), std::string::npos) << text << told;
  }
}

}  // namespace
}  // namespace laboratory

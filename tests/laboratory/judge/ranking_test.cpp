// The number of randomly drawn machines on which an answer to [[best]] holds.
#include "experiments/laboratory/judge/ranking.hpp"

#include <gtest/gtest.h>

#include "experiments/laboratory/judge/rows.hpp"

namespace laboratory {
namespace {

TEST(Rankings, EachCaseOfAQuestionIsToldItsOwn) {
  const Table best{.columns = {"objects", "best"},
                   .axes = 1,
                   .rows = {{std::int64_t{20}, "tree"}, {std::int64_t{60}, "mesh"}}};
  std::vector<BestAnswer> answers(2);
  answers[0].name = "fastest";
  answers[1].name = "busiest";
  for (auto& answer : answers) answer.best = best;
  const auto row = [&](const char* question, std::size_t at, std::int64_t machines) {
    return std::vector<Value>{question, name_axes(best, at), best.rows[at][1],
                              machines, std::int64_t{6},     ""};
  };
  add_rankings(answers, {.columns = {"question", "at", "best", "machines", "of", "others"},
                         .axes = 2,
                         .rows = {row("fastest", 0, 5), row("fastest", 1, 4),
                                  // there is no ranking for the first row of "busiest"
                                  row("busiest", 1, 3)}});
  const auto told = [&](std::size_t question, std::size_t at) {
    return to_string(answers[question].best.rows[at].back());
  };
  EXPECT_EQ(answers[0].best.columns.back(), "best on machines");
  EXPECT_EQ(told(0, 0), "5 of 6");
  EXPECT_EQ(told(0, 1), "4 of 6");
  EXPECT_EQ(told(1, 0), "");
  EXPECT_EQ(told(1, 1), "3 of 6");
}

}  // namespace
}  // namespace laboratory

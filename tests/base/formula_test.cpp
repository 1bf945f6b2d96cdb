// Tests the values of formulas, and the error messages for invalid formulas.
#include "base/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"

namespace base {
namespace {

std::string told_when(const auto& action) {
  try {
    action();
  } catch (const base::BadInput& error) {
    return error.what();
  }
  return {};
}

double eval(const std::string& text) {
  const base::Formula formula(text, "here");
  return formula.eval(std::vector<double>(formula.variables().size(), 2));
}

TEST(Formula, Values) {
  for (const auto& [text, value] :
       std::vector<std::pair<std::string, double>>{{"1.5e3 * a + link.one_way_rate", 3002},
                                                   {"floor(2.7) + ceil(2.2) + log2(8)", 8},
                                                   {"max(1, a, 3) - min(5, a)", 1},
                                                   {"a == 2 && b != 3 ? 5 : 6", 5},
                                                   {"a >= 2 || 0", 1},
                                                   {"sqrt(16)^2", 16},
                                                   {"(a)", 2},
                                                   {" ( a ) * (b)", 4}})
    EXPECT_DOUBLE_EQ(eval(text), value) << text;
  EXPECT_TRUE(std::isinf(eval("1 / (a - b)")));
  EXPECT_TRUE(std::isnan(eval("sqrt(0 - a)")));
}

TEST(Formula, NamesAreListedOnceAndTakeTheirOwnValues) {
  const base::Formula formula("y - x * x / model.y", "here");
  EXPECT_EQ(formula.variables(), (std::vector<std::string>{"model.y", "x", "y"}));
  EXPECT_EQ(formula.eval(std::vector<double>{4, 2, 10}), 9);
  EXPECT_EQ(formula.eval(std::vector<double>{1, 0, 3}), 3);
}

TEST(Formula, AreOfALimitedLength) {
  std::string longest(Formula::MAX_BYTES, '-');
  longest.back() = '1';
  for (const std::string& text : {longest + ' ', std::string(1'000'000, '(')}) {
    const auto told = told_when([&] { eval(text); });
    EXPECT_EQ(told, fmt::format("here: found an expression of {} bytes, expected at most {}",
                                text.size(), Formula::MAX_BYTES));
  }
  EXPECT_EQ(told_when([&] { eval(longest); }).find("bytes"), std::string::npos);
}

TEST(Formula, MistakesAreNamed) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "here: found \"\", expected an expression: "},
           {"1 +", "here: found \"1 +\", expected an expression: "},
           {"(1", "expected an expression"},
           {"2 a", "expected an expression"},
           {"a, b", "a comma outside of a function"},
           {"a = 3", "expected \"==\" for a comparison"},
           {"a <= 3 = 2", "expected \"==\" for a comparison"},
           {"\"text\"", "expected an expression"},
           {"sqr(2)", "here: unknown function \"sqr\", the nearest is \"sqrt\""},
           {"1 + foo (2)", "unknown function \"foo\""},
           {".a + 1", "here: found \".a + 1\", expected an expression: \".a\" is not a name"},
           {"min()", "expected an expression"}}) {
    const auto told = told_when([&, text = text] { eval(text); });
    EXPECT_NE(told.find(message), std::string::npos) << text << ": " << told;
  }
  EXPECT_TRUE(base::Formula::is_name("link.one_way_rate"));
  for (const char* name : {"", "2a", ".a", "a b", "a-b", "é"})
    EXPECT_FALSE(base::Formula::is_name(name)) << name;
}

}  // namespace
}  // namespace base

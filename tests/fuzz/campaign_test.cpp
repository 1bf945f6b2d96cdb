// Findings of a fuzzing campaign. The reader of each test fails at every fourth text that a child
// process gives it.
#include "tests/fuzz/campaign.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "base/errors.hpp"
#include "tests/support/isolated.hpp"

namespace fuzz {
namespace {

struct Told {
  Counts counts;
  std::vector<std::uint64_t> numbers;
  std::set<std::string> sentences;
};

Told run(const std::function<void(const std::string&)>& read, std::uint64_t cases,
         const Limits& limits = {}) {
  std::vector<Trial> trials{{{.name = "test", .ending = ".txt", .folders = {}, .read = read},
                             make_corpus({"a = 1\n", "b 2 c\nd\n"})}};
  Told told;
  run_number(trials, cases, {.seed = 5, .limits = limits, .tell = [&](auto&, const Finding& found) {
                               told.numbers.push_back(found.number);
                               told.sentences.insert(found.what);
                             }});
  told.counts = trials[0].counts;
  return told;
}

template <class Fail>
auto fail_at_fourth(const Fail& fail) {
  return [fail, calls = std::make_shared<int>(0)](const std::string&) {
    if (++*calls == 4) fail();
  };
}

// Executes 5 or 10 cases. Among 10 cases, cases 3 and 7 fail.
template <class Fail>
void expect_told(const Fail& fail, const std::string& sentence, std::uint64_t cases = 10,
                 const Limits& limits = {}) {
  SCOPED_TRACE(sentence);
  const auto told = run(fail_at_fourth(fail), cases, limits);
  using Numbers = std::vector<std::uint64_t>;
  EXPECT_EQ(told.numbers, cases == 10 ? Numbers({3, 7}) : Numbers{3});
  EXPECT_EQ(told.sentences, std::set{sentence});
  EXPECT_EQ(told.counts.cases, cases);
  EXPECT_EQ(told.counts.findings, told.numbers.size());
  EXPECT_EQ(told.counts.accepted, cases - told.numbers.size());
  EXPECT_EQ(told.counts.refused, 0u);
}

TEST(FuzzCampaign, TellsOfReadersThatEndTheProgram) {
  expect_told([] { std::raise(SIGSEGV); },
              test::IS_SANITIZED ? "ended with 1" : "Segmentation fault");
  expect_told([] { std::raise(SIGKILL); }, "Killed");
  expect_told([] { _exit(0); }, "ended with 0");
}

TEST(FuzzCampaign, TellsOfReadersThatDoNotEnd) {
  expect_told(
      [] {
        volatile bool goes_on = true;
        while (goes_on) {
        }
      },
      "takes more than 0.2 s of the processor", 5, {.cpu_s = 0.2});
  expect_told([] { pause(); }, "takes more than 2 s", 5, {.wall_s = 2});
}

TEST(FuzzCampaign, TellsOfWhatReadersThrow) {
  expect_told([] { throw Broken("a cell differs"); }, "fuzz::Broken: a cell differs");
  expect_told([] { throw std::out_of_range("at"); }, "std::out_of_range: at");
  expect_told([] { throw 1; }, "throws what is no exception");
}

TEST(FuzzCampaign, TellsOfReadersThatWantTooMuchMemory) {
  if (test::IS_SANITIZED) GTEST_SKIP() << "a sanitizer needs the memory";
  expect_told([] { std::vector<char>(std::size_t{3} << 30); }, "std::bad_alloc: std::bad_alloc");
}

TEST(FuzzCampaign, CountsWhatIsRefused) {
  const auto told = run(fail_at_fourth([] { throw base::BadInput("line 1"); }), 10);
  EXPECT_TRUE(told.numbers.empty());
  EXPECT_EQ(told.counts.cases, 10u);
  // all texts are read by one child process, in which the reader refuses the fourth
  EXPECT_EQ(told.counts.refused, 1u);
  EXPECT_EQ(told.counts.accepted, 9u);
}

TEST(FuzzCampaign, EndsWithManyFindings) {
  const auto told = run([](const std::string&) { _exit(7); }, 100);
  EXPECT_EQ(told.counts.findings, MOST_FINDINGS);
  EXPECT_EQ(told.counts.cases, MOST_FINDINGS);
  EXPECT_EQ(told.numbers.back(), MOST_FINDINGS - 1);
}

TEST(FuzzCampaign, MakesTheTextOfANumberAgain) {
  const Trial trial{{.name = "test", .ending = ".txt", .folders = {}, .read = {}},
                    make_corpus({"a = 1\n", "b 2 c\nd\n"})};
  const auto fails = [](const std::string& text) { return text.size() % 13 == 12; };
  const auto told = run(
      [&](const auto& text) {
        if (fails(text)) throw Broken("long");
      },
      700);
  std::vector<std::uint64_t> expected;
  for (std::uint64_t i = 0; i < 700 && expected.size() < MOST_FINDINGS; ++i)
    if (fails(make_case(trial, 5, i))) expected.push_back(i);
  EXPECT_EQ(told.numbers, expected);
  EXPECT_FALSE(expected.empty());
}

}  // namespace
}  // namespace fuzz

#include "experiments/laboratory/judge/test_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/text.hpp"

namespace laboratory {
namespace {

std::size_t count_cases(const std::vector<TestCase>& cases, TestOutcome outcome) {
  return static_cast<std::size_t>(std::ranges::count(cases, outcome, &TestCase::outcome));
}

std::string format_counts(const std::vector<TestCase>& cases) {
  return fmt::format(R"(tests="{}" failures="{}" errors="{}" skipped="{}")", cases.size(),
                     count_cases(cases, TestOutcome::failed),
                     count_cases(cases, TestOutcome::error),
                     count_cases(cases, TestOutcome::skipped));
}

// The element inside <testcase> that states the outcome; "" for passed cases.
std::string format_outcome(const TestCase& test) {
  const auto message = base::escape_xml(test.summary);
  switch (test.outcome) {
    case TestOutcome::passed:
      return "";
    case TestOutcome::skipped:
      return fmt::format("      <skipped message=\"{}\"/>\n", message);
    case TestOutcome::failed:
      return fmt::format("      <failure type=\"check\" message=\"{}\">{}</failure>\n", message,
                         base::escape_xml(test.details));
    case TestOutcome::error:
      return fmt::format("      <error type=\"run\" message=\"{}\"/>\n", message);
  }
  return "";
}

std::string format_case(const TestCase& test) {
  std::string xml = fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n",
                                base::escape_xml(test.suite), base::escape_xml(test.name));
  xml += format_outcome(test);
  if (test.outcome == TestOutcome::passed)
    xml += fmt::format("      <system-out>{}</system-out>\n",
                       base::escape_xml(test.summary + "\n" + test.details));
  return xml + "    </testcase>\n";
}

// Splits the cases into runs of consecutive cases of the same experiment.
std::vector<std::vector<TestCase>> split_suites(const std::vector<TestCase>& cases) {
  std::vector<std::vector<TestCase>> suites;
  for (const auto& test : cases) {
    if (suites.empty() || suites.back().back().suite != test.suite) suites.emplace_back();
    suites.back().push_back(test);
  }
  return suites;
}

// Escapes a test description for TAP: it must be one line without #, which begins a directive.
std::string escape_tap(const std::string& text) {
  std::string escaped;
  for (const char c : base::blank_controls(text)) {
    if (c == '#' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

// Quotes a text in the way that both JSON and YAML accept.
std::string quote_yaml(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Formats a block of YAML, indented by two blanks. Texts are in double quotes, because Perl's TAP
// reader accepts a colon only in quoted texts.
std::string format_yaml(const TestCase& test) {
  std::string yaml = "  ---\n  message: " + quote_yaml(test.summary) + "\n";
  if (!test.details.empty()) yaml += "  points:\n";
  std::istringstream lines(test.details);
  for (std::string line; std::getline(lines, line);) yaml += "    - " + quote_yaml(line) + "\n";
  return yaml + "  ...\n";
}

}  // namespace

TestCase make_test_case(const std::string& suite, const CheckResult& check, const Table& table,
                        std::size_t most) {
  static const std::map<Verdict, TestOutcome> OUTCOMES{{Verdict::holds, TestOutcome::passed},
                                                       {Verdict::fails, TestOutcome::failed},
                                                       {Verdict::unmatched, TestOutcome::skipped}};
  return {suite, check.check.name, OUTCOMES.at(check.verdict), summarize(check, table),
          check.points.empty() ? "" : to_text(make_check_table(check, table, most))};
}

std::string make_junit(const std::vector<TestCase>& cases) {
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tlab verify\" {}>\n",
      format_counts(cases));
  for (const auto& suite : split_suites(cases)) {
    xml += fmt::format("  <testsuite name=\"{}\" {}>\n", base::escape_xml(suite[0].suite),
                       format_counts(suite));
    for (const auto& test : suite) xml += format_case(test);
    xml += "  </testsuite>\n";
  }
  return xml + "</testsuites>\n";
}

std::string make_tap(const std::vector<TestCase>& cases) {
  std::string tap = fmt::format("TAP version 13\n1..{}\n", cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& test = cases[i];
    const bool is_good =
        test.outcome == TestOutcome::passed || test.outcome == TestOutcome::skipped;
    tap += fmt::format("{} {} - {}: {}{}\n", is_good ? "ok" : "not ok", i + 1,
                       escape_tap(test.suite), escape_tap(test.name),
                       test.outcome == TestOutcome::skipped ? " # SKIP no completed point" : "");
    tap += format_yaml(test);
  }
  return tap;
}

}  // namespace laboratory

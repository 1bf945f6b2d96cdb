#pragma once
// Outcomes of checks in two formats that CI systems read: JUnit XML and TAP.
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

/// `skipped`: the check covers no completed point. `error`: the experiment could not be run.
enum class TestOutcome { passed, failed, skipped, error };

/// One check of one experiment.
struct TestCase {
  std::string suite;  ///< path of the experiment file
  std::string name;   ///< name of the check
  TestOutcome outcome = TestOutcome::passed;
  std::string summary;  ///< description in one line
  /// lines with the simulated and the expected value of each point; may be empty
  std::string details;
};

/// Describes the outcome of a check; `suite` is its experiment file. The details list all points,
/// or only the worst if there are more than `most`.
TestCase make_test_case(const std::string& suite, const CheckResult& check, const Table& table,
                        std::size_t most);

/// Formats the cases as JUnit XML, with one <testsuite> for each experiment, in the order of the
/// cases. Contains no times, so that equal results give equal bytes.
std::string make_junit(const std::vector<TestCase>& cases);

/// Formats the cases as version 13 of the Test Anything Protocol, with details in YAML.
std::string make_tap(const std::vector<TestCase>& cases);

}  // namespace laboratory

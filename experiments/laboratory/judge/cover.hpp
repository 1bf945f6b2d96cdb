#pragma once
// Whether what was expected lies where simulated machines say that it lies.
#include <optional>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

/// The error of the model itself, which no number of it can mend.
struct OwnError {
  double mean;        ///< of (expected - simulated) / simulated
  double half_width;  ///< nine of ten further points have theirs within so much of the mean
};

/// From the errors at other points: Student's interval for one point more. None for fewer than
/// three.
std::optional<OwnError> find_own_error(const std::vector<double>& errors);

/// Counts the points whose expected values lie in their intervals; checks that ask that more do
/// fail. Where errors are relative, counts them again for intervals that are moved and made wider
/// by the model's own error, which for each point the check's other points tell.
void check_cover(std::vector<CheckResult>& results, const Table& table,
                 const SurenessTables& sureness);

}  // namespace laboratory

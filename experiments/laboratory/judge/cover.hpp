#pragma once
// Coverage: the share of expected values inside the intervals of the simulated machines.
#include <optional>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

/// The model error that remains for any parameters, relative to the simulated value: (expected -
/// simulated) / simulated. At another point it lies between mean - half_width and mean + half_width
/// with probability 90 %.
struct OwnError {
  double mean, half_width;
};

/// Estimates it from the errors at some points: Student's prediction interval for one further
/// point. None for fewer than three errors.
std::optional<OwnError> find_own_error(const std::vector<double>& errors);

/// Counts, for each check, the predicted points whose expected value lies in the interval that 90 %
/// of the machines span. A check fails if the share of these points is below its `covers`. For
/// relative errors there is a second count. Its intervals are shifted and widened by the model's
/// error, estimated from the other points of the check.
void check_cover(std::vector<CheckResult>& results, const Table& table,
                 const ConfidenceTables& confidence);

}  // namespace laboratory

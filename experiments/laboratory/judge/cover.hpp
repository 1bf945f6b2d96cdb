#pragma once
// Coverage: the share of expected values that lie inside the intervals of the results on randomly
// drawn machines.
#include <optional>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

/// The model's own error, (expected - simulated) / simulated, which remains for any values of the
/// model's parameters. At a further point, this error lies within mean ± half_width with a
/// probability of 90 %.
struct OwnError {
  double mean, half_width;
};

/// Estimates the model's own error from the errors at some points, by Student's prediction interval
/// for one more observation. No value for fewer than three errors.
std::optional<OwnError> find_own_error(const std::vector<double>& errors);

/// Counts, for each check, the expected values at predicted points that lie in the interval of the
/// results on 90 % of the drawn machines. A check fails if their share is below its key `covers`.
/// For checks of relative errors, also counts the expected values in intervals that are shifted and
/// widened by the model's own error. This error is estimated, for each point, from the check's
/// other points.
void check_cover(std::vector<CheckResult>& results, const Table& table,
                 const ConfidenceTables& confidence);

}  // namespace laboratory

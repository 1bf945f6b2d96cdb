#pragma once
// Coverage: the share of expected values that lie inside intervals over machines drawn at random.
#include <optional>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

/// The model's own error, which no choice of parameters removes: (expected - simulated) /
/// simulated. At a further point it lies within mean +- half_width with probability 90 %.
struct OwnError {
  double mean, half_width;
};

/// Estimates the model's own error from the errors at some points, by Student's prediction interval
/// for one further point. None for fewer than three errors.
std::optional<OwnError> find_own_error(const std::vector<double>& errors);

/// Counts, for each check, the predicted points whose expected value lies in the interval of 90 %
/// of the drawn machines. A check fails if the share of these points is below its `covers`. For
/// checks of relative errors, also counts the points in intervals that are shifted and widened by
/// the model's own error, estimated from the check's other points.
void check_cover(std::vector<CheckResult>& results, const Table& table,
                 const ConfidenceTables& confidence);

}  // namespace laboratory

#pragma once
// Whether what was expected lies where simulated machines say that it lies.
#include <optional>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"

namespace laboratory {

/// The error that the model has whatever its numbers are, as a share of what is simulated:
/// (expected - simulated) / simulated. At another point it is expected to lie, in nine cases of
/// ten, between mean - half_width and mean + half_width.
struct OwnError {
  double mean, half_width;
};

/// Estimates it from the errors at some points: Student's prediction interval for one point more.
/// None for fewer than three errors.
std::optional<OwnError> find_own_error(const std::vector<double>& errors);

/// Counts for each check the predicted points whose expected value lies where nine of ten machines
/// are. A check fails if they are a smaller share than its `covers`. Where errors are relative it
/// counts a second time, with wider intervals: a point's is moved and widened by the model's own
/// error, which the other points of the check tell.
void check_cover(std::vector<CheckResult>& results, const Table& table,
                 const SurenessTables& sureness);

}  // namespace laboratory

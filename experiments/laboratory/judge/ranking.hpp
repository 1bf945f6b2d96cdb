#pragma once
// Robustness of the answers to [[best]]: the number of randomly drawn machines that give the same
// answer.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/judge/best.hpp"

namespace laboratory {

/// Makes rankings.csv from the file with drawn machines, `all`, and the results of all its points.
/// Each row has a case of a question, the best value on the nominal model, the number of machines
/// that agree (column "machines") and of all ("of"), and the best values on the machines that
/// disagree. A machine agrees if its best values include those of the nominal model. Machines with
/// incomplete points are skipped.
Table find_rankings(const CheckPlan& plan, const ExperimentFile& file, const ExperimentFile& all,
                    const Results& results);

void save_rankings(const std::filesystem::path& folder, const Table& rankings);
/// Loads rankings.csv; none if the run had no drawn machines or no [[best]]. Throws BadInput for a
/// damaged file.
std::optional<Table> load_rankings(const std::filesystem::path& folder);

/// Adds to each case of the answers the number of machines that agree.
void add_rankings(std::vector<BestAnswer>& answers, const Table& rankings);

/// Formats one sentence for each [[best]]: "fastest: tree is best on 58 of 64 machines, mesh on 6."
std::vector<std::string> tell_rankings(const Table& rankings);

}  // namespace laboratory

#pragma once
// Robustness of the answers to [[best]]: how many randomly drawn machines give the same answer.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/judge/best.hpp"

namespace laboratory {

/// Makes rankings.csv from the experiment with all drawn machines, `all`, and the results of all
/// its points. It has one row for each question and combination of axis values: the best value on
/// the nominal model, the number of machines that agree (column "machines") out of all machines
/// (column "of"), and the best values on the machines that disagree. A machine agrees if its best
/// values include those of the nominal model. Machines with incomplete points do not count.
Table find_rankings(const CheckPlan& plan, const ExperimentFile& file, const ExperimentFile& all,
                    const Results& results);

void save_rankings(const std::filesystem::path& folder, const Table& rankings);
/// Loads rankings.csv; no value if the run had no drawn machines or no [[best]]. Throws BadInput
/// for a damaged file.
std::optional<Table> load_rankings(const std::filesystem::path& folder);

/// Adds to each row of the answers the number of machines that agree.
void add_rankings(std::vector<BestAnswer>& answers, const Table& rankings);

/// Formats one sentence for each [[best]]: "fastest: tree is best on 58 of 64 machines, mesh on 6."
std::vector<std::string> tell_rankings(const Table& rankings);

}  // namespace laboratory

#pragma once
// Confidence in the answers to [[best]]: the number of drawn machines that give the same answer.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/judge/best.hpp"

namespace laboratory {

/// rankings.csv: for each case of each question, the best on the nominal model, the number of
/// machines with the same best ("machines" "of"), and the best on the others. A machine agrees if
/// it ranks at least the same values as best together. `all` is the spread file; `results` has all
/// of its points. Skips machines with incomplete points.
Table find_rankings(const CheckPlan& plan, const ExperimentFile& file, const ExperimentFile& all,
                    const Results& results);

void save_rankings(const std::filesystem::path& folder, const Table& rankings);
/// None without drawn machines or without questions. Throws BadInput for a damaged file.
std::optional<Table> load_rankings(const std::filesystem::path& folder);

/// Adds to each case of the answers the number of machines that agree.
void add_rankings(std::vector<BestAnswer>& answers, const Table& rankings);

/// A sentence for each question: "fastest: tree is best on 58 of 64 machines, mesh on 6."
std::vector<std::string> tell_rankings(const Table& rankings);

}  // namespace laboratory

#pragma once
// With which probability the answers to [[best]] hold: how many of the machines that were drawn
// give the same.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/judge/best.hpp"

namespace laboratory {

/// rankings.csv: for each case of each question what is best on the model as it stands, on how many
/// machines it is ("machines" "of"), and what is best on the others. Best together with others
/// counts; what is best together has to be so on the machine. `all` is the spread file; `results`
/// are those of all its points. Machines that have not all points done are left out.
Table find_rankings(const CheckPlan& plan, const ExperimentFile& file, const ExperimentFile& all,
                    const Results& results);

void save_rankings(const std::filesystem::path& folder, const Table& rankings);
/// None where no machines were drawn or nothing was asked. Throws BadInput for a damaged file.
std::optional<Table> load_rankings(const std::filesystem::path& folder);

/// Adds to each case of the answers on how many machines it is so.
void add_rankings(std::vector<BestAnswer>& answers, const Table& rankings);

/// A sentence for each question: "fastest: tree is best on 58 of 64 machines, mesh on 6."
std::vector<std::string> tell_rankings(const Table& rankings);

}  // namespace laboratory

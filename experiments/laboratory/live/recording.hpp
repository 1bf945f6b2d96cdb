#pragma once
// Converts a session at a page to an experiment file: tlab run on it gives the same results.
#include <string>
#include <vector>

#include "experiments/laboratory/live/user_actions.hpp"

namespace laboratory {

/// The experiment with --set applied, and the user's actions. Paths become relative to `folder`,
/// the folder of the new file. Floating-point numbers are spelled so that they read back unchanged.
std::string record_session(const ExperimentFile& file, const std::vector<UserAction>& actions,
                           const std::string& folder);

}  // namespace laboratory

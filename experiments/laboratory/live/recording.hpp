#pragma once
// Recording of a live session as an experiment file. `tlab run` on the file reproduces the results.
#include <string>
#include <vector>

#include "experiments/laboratory/live/user_actions.hpp"

namespace laboratory {

/// Makes the text of an experiment file: the experiment with --set applied, and the user's orders
/// and faults. Paths become relative to `folder`, where the file will be. Floating-point numbers
/// read back unchanged.
std::string record_session(const ExperimentFile& file, const std::vector<UserAction>& actions,
                           const std::string& folder);

}  // namespace laboratory

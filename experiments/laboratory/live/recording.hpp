#pragma once
// Recording of a live session as an experiment file. `tlab run` of this file reproduces the
// results.
#include <string>
#include <vector>

#include "experiments/laboratory/live/user_actions.hpp"

namespace laboratory {

/// Makes the text of an experiment file: the experiment with the overrides of --set, and the orders
/// and faults that the user gave. Paths in the text are relative to `folder`, where the file will
/// be written. Floating-point numbers are written so that reading them gives the same values.
std::string record_session(const ExperimentFile& file, const std::vector<UserAction>& actions,
                           const std::string& folder);

}  // namespace laboratory

#pragma once
// A session at a page, as an experiment file: tlab run on it gives what the session gave.
#include <string>
#include <vector>

#include "experiments/laboratory/live/hands.hpp"

namespace laboratory {

/// The experiment with --set applied, and what its user did. Files that it names are found from
/// `folder`, where the text is to be put. Floating-point numbers are spelled so that they are read
/// as they were.
std::string record_session(const ExperimentFile& file, const std::vector<Deed>& deeds,
                           const std::string& folder);

}  // namespace laboratory

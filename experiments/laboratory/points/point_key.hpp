#pragma once
// What the result of a point depends on, as a short text: points of equal keys have equal results.
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

// Which program this is: its version, the bytes of its executable, SimGrid's version. A hash.
const std::string& program_id();

// Of each point a hash of the program, the settings that the file and the sweep give, the entries
// of the machine model, what the files hold that the point reads, and the simulated time at which
// it is cut short. Throws as make_model does.
std::vector<std::string> make_keys(const ExperimentFile& file, double until_s);

}  // namespace laboratory

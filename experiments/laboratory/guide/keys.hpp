#pragma once
// Help on the keys of the experiment file, common ones and those of programs.
#include <string>

#include "simulator/programs/programs.hpp"

namespace laboratory {

/// A heading, and a line for each key that any experiment may have.
std::string describe_keys();

/// The program's name and description, and a line for each of its keys: meaning, unit, range and
/// default.
std::string describe_program(const programs::Program& program);

/// A heading, and the description of each program.
std::string describe_programs();

/// The program's results, a line for each column.
std::string describe_columns(const programs::Program& program);

}  // namespace laboratory

#pragma once
// Help on the experiment file: its keys, and the programs with theirs.
#include <string>

#include "simulator/programs/programs.hpp"

namespace laboratory {

/// A heading, and a line for each key that any experiment may have.
std::string describe_keys();

/// The program's name and what it is, and a line for each of its keys: what it is, unit, range and
/// default.
std::string describe_program(const programs::Program& program);

/// A heading, and each program.
std::string describe_programs();

/// The program's results, a line for each column.
std::string describe_columns(const programs::Program& program);

}  // namespace laboratory

#pragma once
// Help on the keys of the experiment file.
#include <string>

#include "simulator/programs/programs.hpp"

namespace laboratory {

/// Formats a heading, and one line for each key that does not belong to a program.
std::string describe_keys();

/// Formats the program's name and description, and one line for each of its keys with meaning,
/// unit, range and default.
std::string describe_program(const programs::Program& program);

/// Formats a heading and the description of each program.
std::string describe_programs();

/// Formats one line for each result column of the program.
std::string describe_columns(const programs::Program& program);

}  // namespace laboratory

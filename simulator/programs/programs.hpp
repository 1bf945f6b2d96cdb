#pragma once
// The list of all programs.
#include "simulator/programs/declare/program.hpp"

namespace programs {

/// All programs, in the order of the help text. The first is the default of the key program.name.
const std::vector<Program>& all_programs();
/// The program with this name; null if there is none.
const Program* find_program(std::string_view name);

}  // namespace programs

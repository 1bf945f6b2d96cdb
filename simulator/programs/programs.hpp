#pragma once
// The list of all programs.
#include "simulator/programs/declare/program.hpp"

namespace programs {

/// All programs, in the order used by the help text. The first is the default of program.name.
const std::vector<Program>& all_programs();
/// The program with this name; null if there is none.
const Program* find_program(std::string_view name);

}  // namespace programs

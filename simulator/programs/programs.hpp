#pragma once
// The list of all programs.
#include "simulator/programs/declare/program.hpp"

namespace programs {

/// In the order of the help text.
const std::vector<Program>& all_programs();
/// Null for an unknown name.
const Program* find_program(std::string_view name);

}  // namespace programs

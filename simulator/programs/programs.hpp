#pragma once
// The list of all programs.
#include <vector>

#include "simulator/programs/declare/program.hpp"

namespace programs {

/// All programs, in the order of the help text. The first is the default of the key program.name.
const std::vector<Program>& all_programs();
/// Appends programs of users to the list. To be called before all other functions of this header,
/// because they return references and pointers into the list. Throws BadInput "programs: ..." or
/// "program NAME: ..." and adds nothing
/// - for a name that is taken, or is not made of small letters, digits and _;
/// - for a program without the function `run`;
/// - if two of its parameters and columns have one name, or the name of a key of [network];
/// - for a parameter whose default is out of its range.
void add_programs(std::vector<Program> own);
/// The program with this name; null if there is none.
const Program* find_program(std::string_view name);

}  // namespace programs

#pragma once
// Help on the keys of the experiment file: keys common to all experiments, and keys of programs.
#include <string>

#include "simulator/programs/programs.hpp"

namespace laboratory {

/// Formats a heading and one line for each key common to all experiments.
std::string describe_keys();

/// Formats one line for each key, of any program, that matches `word`. A key matches if its section
/// or its last part is `word`, or if its last part ends with "_" and `word`. Leaves out the keys of
/// the program `word`, and those of the section [program]. A key that only some programs have is
/// followed by the names of these programs.
std::string describe_keys_of(const std::string& word);

/// Formats the program's name and description, and one line for each of its keys: meaning, unit,
/// range and default.
std::string describe_program(const programs::Program& program);

/// Formats a heading and the description of each program.
std::string describe_programs();

/// Formats one line for each result column of the program.
std::string describe_columns(const programs::Program& program);

}  // namespace laboratory

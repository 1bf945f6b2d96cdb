#pragma once
// The program of an experiment: the farm, or a pattern with its parameters. What [program] and
// [model] may say.
#include <toml++/toml.h>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/values.hpp"
#include "simulator/declare/program.hpp"

namespace laboratory {

// The pattern of that name; null for "farm".
const programs::Pattern* find_pattern(std::string_view program);

// program.name of a file. Throws base::BadInput for an unknown program, with the nearest.
std::string read_program(const toml::table& file, const std::string& origin);

// The choice that a value stands for, or the number.
std::string describe_value(const programs::Parameter& parameter, double value);
// The same of a parameter's value; of a path what the experiment says, "none" where it says
// nothing.
std::string describe_value(const programs::Parameter& parameter, const Experiment& experiment);

// Sets "program.bytes". Throws base::BadInput for a parameter that the pattern does not
// have, with the nearest, and for a value out of its range or a text that is no choice.
void bind_parameter(Experiment& experiment, const programs::Pattern& pattern, const Place& at);

// Sets "model.link.one_way_rate"; the entry's name is checked when the model is made.
void bind_model_entry(Experiment& experiment, const Place& at);

// Throws base::BadInput for a path that names no file, or none where one is required.
void check_files(const Experiment& experiment);

// Throws base::BadInput for a key that says nothing to this pattern: those of the farm.
void check_belongs(const programs::Pattern& pattern, const Place& at);
// The same for routes, tree, faults and timed costs; null is the farm, which has only the last.
void check_used(const programs::Pattern* pattern, const Place& at);

}  // namespace laboratory

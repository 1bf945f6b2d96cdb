// Runs a program, given by its name. Its parameters are also given by their names, as in an
// experiment file.
#pragma once

#include <map>
#include <stdexcept>

#include "simulator/programs/programs.hpp"
#include "topologies/make/generators.hpp"

namespace programs {

using Settings = std::map<std::string, base::Scalar>;

inline const Program& get_program(std::string_view name) {
  if (const Program* program = find_program(std::string(name))) return *program;
  throw std::invalid_argument("no program " + std::string(name));
}

// Throws std::invalid_argument for an unknown parameter or an invalid value.
inline Outcome<Row> run_program(const Program& program, const Setup& setup,
                                const Settings& settings = {}) {
  std::any params = program.defaults;
  for (const auto& [name, value] : settings) {
    const Parameter* parameter = program.find(name);
    if (!parameter) throw std::invalid_argument(program.name + " has no parameter " + name);
    const auto expected = parameter->assign(params, value);
    if (!expected.empty()) throw std::invalid_argument(name + ": expected " + expected);
  }
  return program.run(setup, params);
}
inline Outcome<Row> run_program(const std::string& name, const Setup& setup,
                                const Settings& settings = {}) {
  return run_program(get_program(name), setup, settings);
}

// Makes a setup. It has a small network if the program uses one.
inline Setup make_small_setup(const machine::Model& model, const Program& program) {
  Setup setup{model, topologies::make_topology(program.uses.network ? "tree:4" : "line:1")};
  if (program.uses.routes) setup.routes = topologies::make_routes(setup.topology);
  return setup;
}

inline const base::Cell& get_cell(const Row& row, const std::string& column) {
  for (const auto& [name, cell] : row)
    if (name == column) return cell;
  throw std::out_of_range(column);
}
inline double get_number(const Row& row, const std::string& column) {
  const base::Cell& cell = get_cell(row, column);
  const auto* whole = std::get_if<std::int64_t>(&cell);
  return whole ? static_cast<double>(*whole) : std::get<double>(cell);
}

}  // namespace programs

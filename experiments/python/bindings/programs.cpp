#include "simulator/programs/programs.hpp"

#include <pybind11/stl.h>

#include "experiments/python/bindings/bindings.hpp"
#include "experiments/python/bindings/scalars.hpp"
#include "simulator/machine/model.hpp"

namespace py = pybind11;

namespace bindings {
namespace {

py::dict describe(const programs::Program& program) {
  py::list parameters, columns;
  for (const auto& parameter : program.parameters) {
    auto about = bindings::describe(parameter, program.defaults);
    about["key"] = programs::key_of(parameter);
    parameters.append(about);
  }
  for (const auto& [name, help] : program.columns) columns.append(py::make_tuple(name, help));
  py::dict about;
  about["name"] = program.name;
  about["help"] = program.help;
  about["parameters"] = parameters;
  about["columns"] = columns;
  about["parts"] = program.parts;
  about["network"] = program.uses.network;
  about["routes"] = program.uses.routes;
  return about;
}

}  // namespace

void bind_programs(py::module_& module) {
  module.def("programs", [] {
    py::list all;
    for (const auto& program : programs::all_programs()) all.append(describe(program));
    return all;
  });
  module.def("models", [] { return machine::builtin_models(); });
}

}  // namespace bindings

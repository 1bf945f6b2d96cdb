#pragma once
// What Python sees of the libraries: the module tlab._native, in three parts. The package's own
// modules, in ../tlab, are what its users see.
#include <pybind11/pybind11.h>

namespace bindings {

/// Topologies, their metrics and routes.
void bind_topologies(pybind11::module_& module);
/// The sequential renderer, and pictures from files.
void bind_pictures(pybind11::module_& module);
/// What the machine's programs declare of themselves.
void bind_programs(pybind11::module_& module);

}  // namespace bindings

#pragma once
// Python bindings of the C++ libraries: the module tlab._native, in three parts. Users should use
// only the modules of the package in ../tlab.
#include <pybind11/pybind11.h>

namespace bindings {

/// Adds topologies, their metrics and routes.
void bind_topologies(pybind11::module_& module);
/// Adds the sequential renderer and the reader of picture files.
void bind_pictures(pybind11::module_& module);
/// Adds the parameters and result columns that the simulated programs declare.
void bind_programs(pybind11::module_& module);

}  // namespace bindings

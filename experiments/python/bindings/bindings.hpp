#pragma once
// Python bindings of the libraries: the module tlab._native, in three parts. Users see only the
// modules of the package in ../tlab.
#include <pybind11/pybind11.h>

namespace bindings {

/// Topologies, their metrics and routes.
void bind_topologies(pybind11::module_& module);
/// The sequential renderer and the reader of picture files.
void bind_pictures(pybind11::module_& module);
/// The parameters and columns that the simulated programs declare.
void bind_programs(pybind11::module_& module);

}  // namespace bindings

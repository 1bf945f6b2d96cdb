#include "base/errors.hpp"
#include "experiments/python/bindings/bindings.hpp"

namespace py = pybind11;

// Translates BadInput to the Python exception that stands for exit code 2 of tlab.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const base::BadInput& e) {
    const auto type = py::module_::import("tlab.errors").attr("BadInput");
    PyErr_SetString(type.ptr(), e.what());
  }
}

PYBIND11_MODULE(_native, module) {
  module.attr("VERSION") = TLAB_VERSION;
  module.doc() = "What the package tlab takes from tlab's libraries.";
  py::register_exception_translator(&translate);
  bindings::bind_topologies(module);
  bindings::bind_pictures(module);
  bindings::bind_programs(module);
}

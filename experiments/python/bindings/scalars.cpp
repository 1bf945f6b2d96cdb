#include "experiments/python/bindings/scalars.hpp"

#include <pybind11/stl.h>

#include <stdexcept>

#include "base/errors.hpp"

namespace py = pybind11;

namespace bindings {
namespace {

struct ToPython {
  py::object operator()(std::monostate) const { return py::none(); }
  py::object operator()(const base::Source& source) const {
    if (source.text.empty()) return py::none();
    return py::cast(source.text);
  }
  template <class T>
  py::object operator()(const T& value) const {
    return py::cast(value);
  }
};

}  // namespace

py::object to_python(const base::Scalar& value) { return std::visit(ToPython{}, value); }

const char* name_of(base::Domain::Kind kind) {
  using enum base::Domain::Kind;
  switch (kind) {
    case flag:
      return "flag";
    case whole:
      return "whole";
    case number:
      return "number";
    case choice:
      return "choice";
    case text:
      return "text";
    case list:
      return "list";
    case texts:
      return "texts";
    case expression:
      return "expression";
    case expressions:
      return "expressions";
    case any:
      return "any";
    case file:
      return "file";
    case source:
      return "source";
  }
  throw std::logic_error("unknown kind of values");
}

base::Scalar from_python(const std::string& name, const py::handle& value) {
  try {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return value.cast<std::int64_t>();
    if (py::isinstance<py::float_>(value)) return value.cast<double>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::sequence>(value)) return value.cast<std::vector<double>>();
  } catch (const py::cast_error&) {  // an element of the list is not a number, or is too large
  }
  base::refuse(name, "found {}, expected a number, a text or numbers in a list",
               py::repr(value).cast<std::string>());
}

}  // namespace bindings

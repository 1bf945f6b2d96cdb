#pragma once
// Values of fields, to Python and from it.
#include <pybind11/pybind11.h>

#include "base/fields.hpp"

namespace bindings {

/// None for what was not given; of a source its text, or None where there is none.
pybind11::object to_python(const base::Scalar& value);

/// A bool, int, float, str, or sequence of numbers. Throws BadInput, beginning with `name`, for
/// anything else.
base::Scalar from_python(const std::string& name, const pybind11::handle& value);

/// Name, unit, help, kind ("whole", "choice", ...), range and choices of a field, and its default.
template <class P>
pybind11::dict describe(const base::Field<P>& field, const P& defaults) {
  static constexpr const char* KINDS[] = {"flag", "whole", "number", "choice",
                                          "text", "list",  "file",   "source"};
  const auto& domain = field.domain;
  pybind11::dict about;
  about["name"] = field.name;
  about["unit"] = field.unit;
  about["help"] = field.help;
  about["kind"] = KINDS[static_cast<int>(domain.kind)];
  about["low"] = domain.low;
  about["high"] = domain.high;
  about["choices"] = pybind11::tuple(pybind11::cast(domain.choices));
  about["required"] = domain.is_required;
  about["default"] = to_python(field.get(defaults));
  if (domain.kind == base::Domain::Kind::flag) about["default"] = pybind11::bool_(about["default"]);
  return about;
}

}  // namespace bindings

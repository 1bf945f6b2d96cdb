#pragma once
// Converts field values to Python and back.
#include <pybind11/pybind11.h>

#include "base/fields.hpp"

namespace bindings {

/// Converts a value to Python. A field without a value becomes None. A base::Source becomes the
/// text that the user wrote, or None if this text is empty.
pybind11::object to_python(const base::Scalar& value);

/// Converts a Python bool, int, float, str, or sequence of numbers. Throws BadInput with the prefix
/// `name` for other values.
base::Scalar from_python(const std::string& name, const pybind11::handle& value);

/// The Python name of a kind of values.
const char* name_of(base::Domain::Kind kind);

/// Describes a field: its name, unit, help, kind ("whole", "choice", ...), range, choices and
/// default.
template <class P>
pybind11::dict describe(const base::Field<P>& field, const P& defaults) {
  const auto& domain = field.domain;
  pybind11::dict about;
  about["name"] = field.name;
  about["unit"] = field.unit;
  about["help"] = field.help;
  about["kind"] = name_of(domain.kind);
  about["low"] = domain.low;
  about["high"] = domain.high;
  about["choices"] = pybind11::tuple(pybind11::cast(domain.choices));
  about["required"] = domain.is_required;
  about["default"] = to_python(field.get(defaults));
  if (domain.kind == base::Domain::Kind::flag) about["default"] = pybind11::bool_(about["default"]);
  return about;
}

}  // namespace bindings

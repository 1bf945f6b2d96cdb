#pragma once
// An entry of a model file, read from TOML. Only model_file.cpp uses this header.
#include <string>

#include "base/toml.hpp"
#include "simulator/machine/model.hpp"

namespace machine {

inline constexpr double LARGEST_ENTRY = 1e12;  ///< upper bound of all entries, in any unit

/// Reads the entry `key`. Messages of errors begin with `where`.
Entry read_entry(const std::string& key, const toml::node& node, const std::string& where);

/// Sets a number, or a formula after a check of its syntax.
void set_value(Entry& entry, const EntryValue& value);

}  // namespace machine

#pragma once
// Reading of one entry of a model file from TOML. Only model_file.cpp uses this header.
#include <string>

#include "base/toml.hpp"
#include "simulator/machine/model.hpp"

namespace machine {

inline constexpr double LARGEST_ENTRY = 1e12;  ///< upper bound of all entries, in any unit

/// Reads the entry named `key`. Error messages begin with `where`.
Entry read_entry(const std::string& key, const toml::node& node, const std::string& where);

/// Sets an entry's value to a number, or to a formula after checking its syntax.
void set_value(Entry& entry, const EntryValue& value);

}  // namespace machine

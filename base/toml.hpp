#pragma once
// TOML files. The only door to toml++'s parser and to what it writes.
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace base {

/// Most parts of a key such as a.b.c, in its own line or in a section's name.
constexpr int MAX_KEY_PARTS = 16;

/// Throws BadInput "origin:line: ..." for what is no TOML, for a longer key, for one with a single
/// quote, a tab or a line end in it, and for the least of all 64-bit numbers.
toml::table parse_toml(std::string_view text, std::string_view origin);

/// A value as TOML spells it, whole numbers in decimal; parse_toml reads a table's text as the same
/// table.
std::string to_toml(const toml::node& node);

}  // namespace base

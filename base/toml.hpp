#pragma once
// Reading and writing of TOML. Only this module calls the parser and the formatter of toml++.
#define TOML_HEADER_ONLY 0  // use the functions compiled in the shared library
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace base {

/// Maximum number of parts in a key such as a.b.c, or in a section's name.
constexpr int MAX_KEY_PARTS = 16;

/// Parses TOML. `origin` names the text in messages. Throws BadInput "origin:line: ..." for
/// malformed TOML, a key of more than MAX_KEY_PARTS parts, a key with a single quote, a tab or a
/// line end, and the smallest 64-bit integer.
toml::table parse_toml(std::string_view text, std::string_view origin);

/// Writes a value as TOML, with integers in decimal. parse_toml restores a table from its text.
std::string to_toml(const toml::node& node);

}  // namespace base

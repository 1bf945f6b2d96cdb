#include "base/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "base/errors.hpp"

namespace base {

namespace {

// Length of the quoted string at the start of the text, which may span several lines.
std::size_t measure_string(std::string_view text) {
  const char mark = text[0];
  const bool has_lines = text.substr(1, 2) == std::string_view{mark == '"' ? "\"\"" : "''"};
  const auto end = text.substr(0, has_lines ? 3 : 1);
  std::size_t at = end.size();
  while (at < text.size() && !text.substr(at).starts_with(end)) {
    if (text[at] == '\n' && !has_lines) return at;
    at += mark == '"' && text[at] == '\\' ? 2 : 1;
  }
  at = std::min(at + end.size(), text.size());
  // One or two quote marks directly before the closing three are part of the string.
  for (int i = 0; i < 2 && has_lines && at < text.size() && text[at] == mark; ++i) ++at;
  return at;
}

bool continues_key(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) || c == '_' || c == '-' || c == ' ' || c == '\t';
}

// Limits the number of parts in a key. toml++ makes a nested table for each part and destroys the
// tables recursively, so that a long key could overflow the stack. Refuses bytes beyond ASCII
// outside strings and comments, where the behaviour of toml++ is undefined.
void check_keys(std::string_view text, std::string_view origin) {
  constexpr std::string_view MARK = "\xef\xbb\xbf";  // UTF-8 byte order mark
  if (text.starts_with(MARK)) text.remove_prefix(MARK.size());
  int line = 1, parts = 1;
  for (std::size_t at = 0, length = 0; at < text.size(); at += length) {
    const char c = text[at];
    const auto rest = text.substr(at);
    const bool is_string = c == '"' || c == '\'';
    length = is_string  ? measure_string(rest)
             : c == '#' ? std::min(rest.find('\n'), rest.size())
                        : 1;
    // Formats the place only for an error, because `origin` contains the text of a value of --set,
    // which can be long.
    const auto place = [&] { return fmt::format("{}:{}", origin, line); };
    if (!is_string && static_cast<unsigned char>(c) >= 0x80)
      refuse(place(), "found a letter beyond ASCII, expected it in a text or a comment");
    if (c == '.') {
      if (++parts > MAX_KEY_PARTS)
        refuse(place(), "found a key of more than {0} parts, expected at most {0}", MAX_KEY_PARTS);
    } else if (!is_string && !continues_key(c))
      parts = 1;
    line += static_cast<int>(std::ranges::count(rest.substr(0, length), '\n'));
  }
}

// Refuses values that toml++ writes wrongly. It does not quote keys that contain a single quote, a
// tab or a line end, and it loses the sign of the smallest 64-bit integer.
void check_nodes(const toml::node& node, std::string_view origin) {
  const auto place = [&](const auto& at) { return fmt::format("{}:{}", origin, at.begin.line); };
  if (const auto* list = node.as_array())
    for (const auto& entry : *list) check_nodes(entry, origin);
  if (const auto* number = node.as_integer())
    if (number->get() == std::numeric_limits<std::int64_t>::min())
      refuse(place(node.source()), "found {}, expected a larger number", number->get());
  const auto* table = node.as_table();
  if (!table) return;
  for (const auto& [key, value] : *table) {
    if (key.str().find_first_of("'\t\n") != key.str().npos)
      refuse(place(key.source()),
             "found a key with a quote, a tab or a line end, expected none in it");
    check_nodes(value, origin);
  }
}

// True if the node contains a multi-line string.
bool has_lines(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get().find('\n') != std::string::npos;
  if (const auto* list = node.as_array()) return std::ranges::any_of(*list, has_lines);
  const auto* table = node.as_table();
  return table &&
         std::ranges::any_of(*table, [](const auto& entry) { return has_lines(entry.second); });
}

}  // namespace

toml::table parse_toml(std::string_view text, std::string_view origin) {
  check_keys(text, origin);
  try {
    toml::table file = toml::parse(text, origin);
    check_nodes(file, origin);
    return file;
  } catch (const toml::parse_error& error) {
    const auto place = fmt::format("{}:{}", origin, error.source().begin.line);
    require(error.description().find("TOML_MAX_NESTED_VALUES") == std::string_view::npos, place,
            "found arrays or tables in more than {0} others, expected at most {0}",
            TOML_MAX_NESTED_VALUES);
    refuse(place, "{}", error.description());
  }
}

std::string to_toml(const toml::node& node) {
  // Uses the shortest decimal form. toml++ would write 17 digits, such as 0.10000000000000001.
  if (const auto number = node.value_exact<double>(); number && std::isfinite(*number)) {
    const auto text = fmt::format("{}", *number);
    return text.find_first_of(".e") == text.npos ? text + ".0" : text;
  }
  using enum toml::format_flags;
  auto flags = toml::toml_formatter::default_flags;
  flags &= ~(allow_binary_integers | allow_octal_integers | allow_hexadecimal_integers);
  // toml++ writes multi-line strings between triple quotes without a check. An empty first line
  // would be lost, and triple quotes inside the string would end it.
  if (has_lines(node)) flags &= ~(allow_multi_line_strings | allow_literal_strings);
  std::ostringstream text;
  text << toml::toml_formatter(node, flags);
  return text.str();
}

}  // namespace base

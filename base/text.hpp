#pragma once
// Helpers for text: words, numbers, quotes and UTF-8.
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// The text without blanks, tabs and line ends at both ends.
std::string_view trim(std::string_view text);

/// The trimmed parts between separators. A text without separators is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The text with its ASCII letters in lower case.
std::string to_lower(std::string_view text);

/// Parses the whole text as a number, independent of the locale. Returns none for anything else,
/// even for a number with surrounding blanks.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// The name in `known` with the smallest edit distance from `name` (count_edits in
/// base/message.hpp). If several names are equally near, returns the first of them. `known` must
/// not be empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// Puts a word in single quotes, for messages. Shortens it to 40 bytes. Bytes that are not
/// printable ASCII become escapes such as "\x0a".
std::string quote(std::string_view word);

/// Length in bytes of the UTF-8 character at the start of `text`, which must not be empty. Returns
/// 0 if the text does not start with a valid character.
std::size_t measure_utf8(std::string_view text);
/// True if the text is valid UTF-8, as JSON and TOML require.
bool is_utf8(std::string_view text);

/// Replaces each control character, including line ends, by `instead`. The result is one line and
/// cannot control a terminal.
std::string blank_controls(std::string_view text, char instead = ' ');

/// Escapes a text for elements and quoted attributes of XML and HTML. Characters that XML cannot
/// hold become U+FFFD: control characters other than line ends, tabs and DEL, and bytes that are
/// not UTF-8.
std::string escape_xml(std::string_view text);

/// The first sentence of the comment at the start of a source file. The comment consists of lines
/// that start with # or //. Returns "" if there is no comment.
std::string first_comment(std::string_view text);

}  // namespace base

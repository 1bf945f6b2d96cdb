#pragma once
// Helpers for text: words, numbers, quotes and UTF-8.
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// The text without leading and trailing blanks, tabs and line ends.
std::string_view trim(std::string_view text);

/// The parts between separators, each trimmed; a text without a separator is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Parses a whole text as a number, in any locale; none for any other text, also with blanks.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// The name among `known` (not empty) at the smallest edit distance from `name` (count_edits in
/// base/message.hpp); the first of several.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// Quotes a word for messages: in single quotes, at most 40 bytes; bytes that are not printable
/// ASCII become escapes such as "\x0a".
std::string quote(std::string_view word);

/// The length in bytes of the UTF-8 character at the start of the text (not empty); 0 without one.
std::size_t measure_utf8(std::string_view text);
/// True if the text is valid UTF-8, as JSON and TOML require.
bool is_utf8(std::string_view text);

/// Puts a text on one line: replaces control characters, which could also command a terminal.
std::string blank_controls(std::string_view text, char instead = ' ');

/// Escapes a text for elements and quoted attributes of XML and HTML. Control characters other than
/// line ends, tabs and DEL become U+FFFD, since XML cannot hold them.
std::string escape_xml(std::string_view text);

/// The first sentence of a file's leading comment, in lines with # or //; "" without a comment.
std::string first_comment(std::string_view text);

}  // namespace base

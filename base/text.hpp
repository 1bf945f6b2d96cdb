#pragma once
// Words, numbers and quotes in texts that people read and write.
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// The text without the blanks, tabs and line ends at its ends.
std::string_view trim(std::string_view text);

/// The parts between separators, each trimmed; a text without a separator is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The number that a text is, whatever the locale; none for anything else, blanks included.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// The name among `known` (not empty) that takes the fewest edits from `name` (count_edits in
/// base/message.hpp); of several the first.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// A word as messages show it: in single quotes, at most 40 bytes, others than printable ASCII as
/// "\x0a".
std::string quote(std::string_view word);

/// The number of bytes of the UTF-8 character that begins the text (not empty); 0 where there is
/// none.
std::size_t measure_utf8(std::string_view text);
/// Whether the text is UTF-8, as JSON and TOML are.
bool is_utf8(std::string_view text);

/// A text on one line: control characters, which would also command a terminal, become `instead`.
std::string blank_controls(std::string_view text, char instead = ' ');

/// A text for elements and quoted attributes of XML and HTML. Control characters that XML cannot
/// hold, all but line ends, tabs and DEL, become U+FFFD.
std::string escape_xml(std::string_view text);

/// The first sentence of the comment that a file begins with, in lines with # or //; "" without.
std::string first_comment(std::string_view text);

}  // namespace base

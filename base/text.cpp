#include "base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "base/message.hpp"

namespace base {

namespace {

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

}  // namespace

std::string_view trim(std::string_view text) {
  constexpr std::string_view BLANKS = " \t\r\n";
  const auto first = text.find_first_not_of(BLANKS);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(BLANKS) + 1 - first);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(separator, at), text.size());
    parts.push_back(trim(text.substr(at, end - at)));
    at = end + 1;
  }
  return parts;
}

std::string to_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  return *std::ranges::min_element(
      known, {}, [&](const std::string& candidate) { return count_edits(name, candidate); });
}

std::string quote(std::string_view word) {
  constexpr std::size_t MOST = 40;
  std::string shown;
  for (const char c : word.substr(0, MOST))
    shown += c >= ' ' && c <= '~' ? std::string(1, c)
                                  : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return fmt::format("'{}{}'", shown, word.size() > MOST ? "..." : "");
}

std::size_t measure_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80   ? 1
                             : byte(0) < 0xc2 ? 0
                             : byte(0) < 0xe0 ? 2
                             : byte(0) < 0xf0 ? 3
                             : byte(0) < 0xf5 ? 4
                                              : 0;
  if (length < 2 || length > text.size()) return length == 1 ? 1 : 0;
  std::uint32_t code = byte(0) & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t LEAST[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code < LEAST[length] || code > 0x10ffff || is_surrogate ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const auto length = measure_utf8(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string blank_controls(std::string_view text, char instead) {
  std::string line(text);
  std::ranges::replace_if(line, is_control, instead);
  return line;
}

std::string escape_xml(std::string_view text) {
  constexpr std::string_view REPLACEMENT = "\xef\xbf\xbd";
  static const std::map<std::string_view, std::string_view> ESCAPES{
      {"&", "&amp;"},
      {"<", "&lt;"},
      {">", "&gt;"},
      {"\"", "&quot;"},
      {"'", "&#39;"},
      {"\xef\xbf\xbe", REPLACEMENT},
      {"\xef\xbf\xbf", REPLACEMENT}};  // XML excludes U+FFFE, U+FFFF
  std::string escaped;
  while (!text.empty()) {
    const auto length = measure_utf8(text);
    const auto character = text.substr(0, std::max<std::size_t>(length, 1));
    text.remove_prefix(character.size());
    const char c = character[0];
    const bool is_invalid = length == 0 || (is_control(static_cast<unsigned char>(c)) &&
                                            c != '\n' && c != '\t' && c != '\x7f');
    const auto found = ESCAPES.find(character);
    escaped += is_invalid ? REPLACEMENT : found != ESCAPES.end() ? found->second : character;
  }
  return escaped;
}

std::string first_comment(std::string_view text) {
  std::string comment;
  for (auto line : split(text, '\n')) {
    line = trim(line);
    const std::size_t marker = line.starts_with("//") ? 2 : line.starts_with('#') ? 1 : 0;
    if (marker == 0) break;
    if (!comment.empty()) comment += ' ';
    comment += trim(line.substr(marker));
  }
  auto end = comment.find(". ");
  const auto is_initial = [&] {  // true if the full stop ends an initial, as in "R. Cook"
    return end != comment.npos && end > 1 && comment[end - 2] == ' ' &&
           std::isupper(static_cast<unsigned char>(comment[end - 1]));
  };
  while (is_initial()) end = comment.find(". ", end + 1);
  comment.resize(std::min(end, comment.size()));
  if (comment.ends_with('.')) comment.pop_back();
  return comment;
}

}  // namespace base

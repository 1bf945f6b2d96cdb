#include "base/text.hpp"

#include <fmt/format.h>

#include <algorithm>

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

std::string blank_controls(std::string_view text, char instead) {
  std::string line(text);
  std::ranges::replace_if(line, is_control, instead);
  return line;
}

std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else if (c == '\'')
      escaped += "&#39;";
    else if (is_control(static_cast<unsigned char>(c)) && c != '\n' && c != '\t' && c != '\x7f')
      escaped += "\xef\xbf\xbd";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace base

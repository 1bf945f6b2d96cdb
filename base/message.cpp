#include "base/message.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/text.hpp"

namespace base {

namespace {

// Length in bytes of the text's first character; 0 if it is not printable UTF-8.
std::size_t measure_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const bool is_control = byte(0) < 0x20 || byte(0) == 0x7f;
  const auto length = measure_utf8(text);
  // Characters that change the direction of text: U+202A to U+202E and U+2066 to U+2069.
  const auto turns = [&](unsigned char second, unsigned char first, unsigned char last) {
    return length == 3 && byte(0) == 0xe2 && byte(1) == second && byte(2) >= first &&
           byte(2) <= last;
  };
  if (turns(0x80, 0xaa, 0xae) || turns(0x81, 0xa6, 0xa9)) return 0;
  // The C1 control characters, U+0080 to U+009F.
  const bool is_later_control = length == 2 && byte(0) == 0xc2 && byte(1) < 0xa0;
  return is_control || is_later_control ? 0 : length;
}

std::string escape(std::string_view text, std::string_view kept = {}) {
  std::string shown;
  for (std::size_t at = 0, length = 0; at < text.size(); at += std::max<std::size_t>(length, 1)) {
    length = measure_character(text.substr(at));
    if (length == 0 && kept.find(text[at]) == kept.npos)
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    else
      shown += text.substr(at, std::max<std::size_t>(length, 1));
  }
  return shown;
}

// True if the byte is a UTF-8 continuation byte.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

std::string show_line(std::string_view line) {
  constexpr std::size_t MOST = 2000, HEAD = 1200, TAIL = 600;
  if (line.size() <= MOST) return escape(line);
  std::size_t from = HEAD, to = line.size() - TAIL;
  while (from > HEAD - 3 && continues(line[from])) --from;
  while (to < line.size() - TAIL + 3 && continues(line[to])) ++to;
  return fmt::format("{} ... ({} bytes) ... {}", escape(line.substr(0, from)), to - from,
                     escape(line.substr(to)));
}

}  // namespace

std::string make_readable(std::string_view message) {
  std::string shown;
  for (;;) {
    const auto end = message.find('\n');
    shown += show_line(message.substr(0, end));
    if (end == message.npos) return shown;
    shown += '\n';
    message.remove_prefix(end + 1);
  }
}

std::string show_controls(std::string_view text) { return escape(text, "\n\t"); }

std::size_t count_edits(std::string_view a, std::string_view b) {
  // Rows of the table of edit distances. `row` holds the distances between one prefix of `a` and
  // every prefix of `b`. `back` and `two_back` are the rows for the prefixes of `a` that are one
  // and two letters shorter.
  std::vector<std::size_t> two_back, back, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    two_back = std::exchange(back, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({back[j] + (a[i] != b[j]), back[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
        row[j + 1] = std::min(row[j + 1], two_back[j - 1] + 1);
    }
  }
  return row.back();
}

std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known) {
  constexpr std::size_t LONGEST = 200;  // in bytes; the edit distance takes quadratic time
  constexpr std::size_t SHORTEST_PART = 3;
  if (known.empty() || name.size() > LONGEST) return {};
  auto nearest = nearest_name(name, known);
  if (3 * count_edits(name, nearest) <= std::max(name.size(), nearest.size()) + 2) return nearest;
  std::vector<std::string> parts;
  for (const auto& other : known)
    if (std::min(name.size(), other.size()) >= SHORTEST_PART &&
        (other.find(name) != other.npos || name.find(other) != name.npos))
      parts.push_back(other);
  return parts.empty() ? std::nullopt : std::optional(nearest_name(name, parts));
}

std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase) {
  if (const auto similar = find_similar(name, known))
    return fmt::format(", {} \"{}\"", phrase, blank_controls(*similar));
  const auto all = blank_controls(fmt::format("{}", fmt::join(known, ", ")));
  return known.empty() ? "" : ", expected one of " + all;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const auto similar = find_similar(name, known);
  return similar ? fmt::format(" (did you mean \"{}\"?)", blank_controls(*similar)) : "";
}

}  // namespace base

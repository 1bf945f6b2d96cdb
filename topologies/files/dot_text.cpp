#include "topologies/files/dot_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/errors.hpp"

namespace topologies {
namespace {

constexpr int MAX_NESTING = 100;

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' ||
         static_cast<unsigned char>(c) >= 128;
}

size_t skip_past(std::string_view text, size_t from, std::string_view end) {
  const auto found = text.find(end, from);
  return found == text.npos ? text.size() : found + end.size();
}

// The length of the token at `at`: white space, comment, quoted string, HTML, word or one symbol.
size_t measure_token(std::string_view text, size_t at) {
  const auto rest = text.substr(at);
  const auto run = [&](auto belongs) {
    return static_cast<size_t>(std::ranges::find_if_not(rest, belongs) - rest.begin());
  };
  const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  if (is_space(rest[0])) return run(is_space);
  if (is_word(rest[0])) return run(is_word);
  if (rest.starts_with("--") || rest.starts_with("->")) return 2;
  if (rest.starts_with("//")) return skip_past(rest, 2, "\n");
  if (rest.starts_with("/*")) return skip_past(rest, 2, "*/");
  if (rest[0] == '#' && (at == 0 || text[at - 1] == '\n')) return skip_past(rest, 1, "\n");
  if (rest[0] == '"') {
    size_t i = 1;
    while (i < rest.size() && rest[i] != '"') i += rest[i] == '\\' ? 2 : 1;
    return std::min(i + 1, rest.size());
  }
  if (rest[0] == '<') {
    int depth = 0;
    size_t i = 0;
    do depth += rest[i] == '<' ? 1 : rest[i] == '>' ? -1 : 0;
    while (++i < rest.size() && depth > 0);
    return i;
  }
  return 1;
}

bool is_gap(std::string_view token) {
  return std::isspace(static_cast<unsigned char>(token[0])) || token[0] == '#' ||
         token.starts_with("//") || token.starts_with("/*");
}

bool is_identifier(std::string_view token) {
  return !token.empty() && (is_word(token[0]) || token[0] == '"');
}

std::string unquote(std::string_view token) {
  if (token.size() < 2 || token[0] != '"') return std::string(token);
  std::string result;
  for (size_t i = 1; i + 1 < token.size(); ++i)
    if (token.substr(i, 2) != "\\\"") result += token[i];
  return result;
}

}  // namespace

DotText make_dot_text(const std::string& text, const std::string& file) {
  DotText result;
  std::string_view before, last;  // tokens
  int line = 1, braces = 0, brackets = 0, named = 0;
  const auto refuse = [&](const std::string& what) {
    throw base::BadInput(fmt::format("{}: line {}: {}", file, line, what));
  };
  const size_t start = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  for (size_t at = start, length = 0; at < text.size(); at += length) {
    length = measure_token(text, at);
    const auto token = std::string_view(text).substr(at, length);
    const char c = token[0];
    if (c == '{' && ++braces > MAX_NESTING)
      refuse(fmt::format("more than {} nested braces", MAX_NESTING));
    if (c == ':' && brackets == 0)
      refuse(fmt::format(
          "found a port after a node (\"{}:\"), expected the edge attributes port_a and port_b",
          last));
    const bool joins_groups = (last == "--" || last == "->") && before == "}";
    if (joins_groups && (c == '{' || token == "subgraph"))
      refuse("an edge joins two groups in braces, expected a node at one side");
    if (c == '{' && braces > 1 && last != "subgraph" && before != "subgraph")
      result.text += "subgraph ";
    result.text += token;
    line += static_cast<int>(std::ranges::count(token, '\n'));
    if (is_gap(token)) continue;
    const bool assigned = c == '=' || before == "=";  // an attribute: its name or its value
    if (brackets == 0 && is_identifier(last) && !assigned)
      named += result.place.try_emplace(unquote(last), named).second;
    braces -= c == '}', brackets += (c == '[') - (c == ']');
    before = last, last = token;
  }
  return result;
}

}  // namespace topologies

#include "topologies/files/dot_tokens.hpp"

#include <algorithm>
#include <array>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace topologies {
namespace {

using Kind = DotToken::Kind;

constexpr std::array<std::string_view, 6> KEYWORDS{"graph", "digraph", "subgraph",
                                                   "node",  "edge",    "strict"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Bytes beyond ASCII, which may be UTF-8 or Latin-1, count as letters.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 128;
}

std::string to_lower(std::string_view word) {
  std::string lower(word);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

template <typename Belongs>
std::size_t count_leading(std::string_view text, Belongs belongs) {
  return static_cast<std::size_t>(std::ranges::find_if_not(text, belongs) - text.begin());
}

// The length in bytes of the number at the start of the text, such as 12, -1.5, 3. or -.5; 0 if
// there is none.
std::size_t measure_number(std::string_view text) {
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  const auto whole = count_leading(text.substr(sign), is_digit);
  std::size_t length = sign + whole;
  const bool has_point = text.substr(length).starts_with('.');
  const auto digits = has_point ? count_leading(text.substr(length + 1), is_digit) : 0;
  if (has_point) length += 1 + digits;
  return whole + digits == 0 ? 0 : length;
}

}  // namespace

bool is_dot_keyword(std::string_view word) {
  return std::ranges::find(KEYWORDS, to_lower(word)) != KEYWORDS.end();
}

DotTokens::DotTokens(std::string_view text, std::string file)
    : text_(text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text), file_(std::move(file)) {
  next_ = read();
}

DotToken DotTokens::take() {
  auto token = std::move(next_);
  next_ = read();
  return token;
}

bool DotTokens::sees(std::string_view text) const {
  return (next_.kind == Kind::symbol || next_.kind == Kind::keyword) && next_.text == text;
}

bool DotTokens::accept(std::string_view text) {
  if (!sees(text)) return false;
  take();
  return true;
}

void DotTokens::require(std::string_view text) {
  if (!accept(text)) refuse(fmt::format("\"{}\"", text));
}

void DotTokens::refuse(std::string_view expected) const {
  const auto found = next_.kind == Kind::end ? "the end of the file" : base::quote(next_.text);
  refuse_at(next_.line, fmt::format("found {}, expected {}", found, expected));
}

void DotTokens::refuse_at(int line, const std::string& message) const {
  base::refuse(file_, "line {}: {}", line, message);
}

void DotTokens::skip(std::size_t length) {
  line_ += static_cast<int>(std::ranges::count(rest().substr(0, length), '\n'));
  at_ += length;
}

void DotTokens::skip_past(std::string_view end, std::string_view what) {
  const auto found = text_.find(end, at_ + 2);
  if (found == text_.npos)
    refuse_at(line_, fmt::format("found the end of the file in {}, expected {}", what, end));
  skip(found + end.size() - at_);
}

void DotTokens::skip_gaps() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
      skip(1);
    else if (c == '#' || rest().starts_with("//"))
      skip(std::min(rest().find('\n'), rest().size()));
    else if (rest().starts_with("/*"))
      skip_past("*/", "a comment");
    else
      return;
  }
}

DotToken DotTokens::read() {
  skip_gaps();
  if (at_ == text_.size()) return {Kind::end, "", line_};
  const char c = text_[at_];
  if (c == '"') return read_quoted();
  if (c == '<') return read_html();
  if (measure_number(rest()) > 0) return read_number();
  if (is_letter(c)) {
    const auto length = count_leading(rest(), [](char l) { return is_letter(l) || is_digit(l); });
    const auto word = rest().substr(0, length);
    at_ += length;
    if (is_dot_keyword(word)) return {Kind::keyword, to_lower(word), line_};
    return {Kind::word, std::string(word), line_};
  }
  const bool is_edge = rest().starts_with("--") || rest().starts_with("->");
  const std::string symbol(rest().substr(0, is_edge ? 2 : 1));
  if (!is_edge && std::string_view("{}[]=;,:+").find(c) == std::string_view::npos)
    refuse_at(line_, fmt::format("found {}, expected a name, a string or a symbol of DOT",
                                 base::quote(symbol)));
  at_ += symbol.size();
  return {Kind::symbol, symbol, line_};
}

// Refuses a number that a letter follows directly. Graphviz would split 2x into the words 2 and x.
DotToken DotTokens::read_number() {
  const auto length = measure_number(rest());
  const auto longer = count_leading(
      rest(), [](char c) { return is_letter(c) || is_digit(c) || c == '.' || c == '-'; });
  const auto after = rest().substr(length);
  if (!after.empty() && (is_letter(after[0]) || after[0] == '.'))
    refuse_at(line_, fmt::format("found {}, expected a number, or a name in double quotes",
                                 base::quote(rest().substr(0, longer))));
  at_ += length;
  return {Kind::word, std::string(text_.substr(at_ - length, length)), line_};
}

DotToken DotTokens::read_quoted() {
  DotToken token{Kind::string, "", line_};
  std::size_t i = at_ + 1;
  for (; i < text_.size() && text_[i] != '"'; ++i) {
    const auto pair = text_.substr(i, 2);
    if (pair == "\\\"" || pair == "\\\n") {
      ++i;
      if (pair[1] == '"') token.text += '"';
    } else if (pair == "\\\\") {
      ++i;
      token.text += pair;
    } else {
      token.text += text_[i];
    }
  }
  if (i >= text_.size())
    refuse_at(line_, "found the end of the file in a string, expected a double quote");
  skip(i + 1 - at_);
  return token;
}

DotToken DotTokens::read_html() {
  DotToken token{Kind::string, "", line_};
  std::size_t i = at_ + 1;
  for (int depth = 1; i < text_.size(); ++i) {
    depth += text_[i] == '<' ? 1 : text_[i] == '>' ? -1 : 0;
    if (depth == 0) break;
  }
  if (i == text_.size())
    refuse_at(line_, "found the end of the file in HTML, expected \">\" for each \"<\"");
  token.text = text_.substr(at_ + 1, i - at_ - 1);
  skip(i + 1 - at_);
  return token;
}

}  // namespace topologies

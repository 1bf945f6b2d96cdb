#include "renderer/files/text/tokens.hpp"

#include <charconv>

#include "base/text.hpp"

namespace renderer {

namespace {

constexpr std::string_view BLANKS = " \t\v\f", LINE_ENDS = "\r\n", BYTE_ORDER_MARK = "\xEF\xBB\xBF";

// Converts a number in Fortran's notation, such as 1.0D+00, to that of C. Returns "" for other
// words.
std::string from_fortran(std::string_view word) {
  if (word.find_first_not_of("0123456789.+-dD") != word.npos) return "";
  const auto exponent = word.find_first_of("dD");
  if (exponent == word.npos) return "";
  std::string number(word);
  number[exponent] = 'e';
  return number;
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) {
    const auto number = from_fortran(word);
    return number.empty() ? std::nullopt : parse_number(number);
  }
  const bool is_tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
  if (error == std::errc::result_out_of_range && is_tiny) return 0.0;
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

Tokens::Tokens(std::string_view text, std::string name, IsStatement is_statement, Lines lines)
    : text_(text), name_(std::move(name)), is_statement_(is_statement), lines_(lines) {
  const auto head = text_.substr(0, 2);
  if (head == "\xFF\xFE" || head == "\xFE\xFF" || head.find('\0') != head.npos)
    fail(1, "found UTF-16 or binary data, expected text in UTF-8");
  while (text_.ends_with('\x1A') || text_.ends_with('\0')) text_.remove_suffix(1);
}

// Returns the position after the line end at `at`, or `at` if there is no line end.
std::size_t Tokens::skip_line_end(std::size_t at) const {
  if (at >= text_.size() || LINE_ENDS.find(text_[at]) == LINE_ENDS.npos) return at;
  return at + (text_.substr(at, 2) == "\r\n" ? 2 : 1);
}

// Returns the position after a backslash at `at` and the line end that follows it; 0 if they are
// missing.
std::size_t Tokens::find_join(std::size_t at) const {
  if (lines_ != Lines::joined || text_[at] != '\\') return 0;
  const auto end = std::min(text_.find_first_not_of(BLANKS, at + 1), text_.size());
  const auto next = skip_line_end(end);
  return next > end || end == text_.size() ? next : 0;
}

void Tokens::join_line(std::size_t next) {
  at_ = next;
  if (taken_line_ == line_) ++taken_line_;
  ++line_;
}

// Returns the end of the word that starts at `at_`. The '#' in 1.#INF, which Microsoft's library
// writes for infinity, does not start a comment.
std::size_t Tokens::find_word_end() const {
  constexpr std::string_view ENDS = " \t\r\v\f\n#";
  std::size_t end = at_;
  do end = std::min(text_.find_first_of(ENDS, end + 1), text_.size());
  while (text_[end - 1] == '.' && end + 1 < text_.size() && text_[end] == '#' &&
         (text_[end + 1] == 'I' || text_[end + 1] == 'Q' || text_[end + 1] == 'S'));
  return find_join(end - 1) != 0 ? end - 1 : end;
}

void Tokens::fetch() {
  while (next_.empty() && at_ < text_.size()) {
    if (const auto next = skip_line_end(at_); next > at_) {
      at_ = next;
      if (at_ < text_.size()) ++line_;
    } else if (text_[at_] == '#') {
      const auto end = std::min(text_.find_first_of(LINE_ENDS, at_), text_.size());
      const auto comment = base::trim(text_.substr(at_ + 1, end - at_ - 1));
      const bool is_statement = is_statement_ && is_statement_(comment);
      if (is_statement && taken_line_ == line_)
        fail(line_, fmt::format("found {} after other words, expected it on a line of its own",
                                base::quote("# " + std::string(comment))));
      if (is_statement)
        next_ = text_.substr(std::exchange(at_, at_ + 1), 1);
      else
        at_ = end;
    } else if (BLANKS.find(text_[at_]) != BLANKS.npos) {
      ++at_;
    } else if (text_.substr(at_).starts_with(BYTE_ORDER_MARK)) {
      at_ += BYTE_ORDER_MARK.size();
    } else if (const auto next_line = find_join(at_)) {
      join_line(next_line);
    } else {
      const auto end = find_word_end();
      next_ = text_.substr(at_, end - at_);
      at_ = end;
    }
  }
}

std::string Tokens::take_rest() {
  if (!next_.empty()) {
    if (line_ != taken_line_) return {};
    at_ = static_cast<std::size_t>(next_.data() - text_.data());
    next_ = {};
  }
  std::string rest;
  for (;;) {
    const auto end = std::min(text_.find_first_of(LINE_ENDS, at_), text_.size());
    const auto part = base::trim(text_.substr(at_, end - at_));
    const bool is_joined = lines_ == Lines::joined && part.ends_with('\\') &&
                           BLANKS.find(*(&part.back() - 1)) != BLANKS.npos;
    const auto kept = is_joined ? base::trim(part.substr(0, part.size() - 1)) : part;
    rest += fmt::format("{}{}", rest.empty() || kept.empty() ? "" : " ", kept);
    at_ = end;
    if (!is_joined) return rest;
    join_line(skip_line_end(end));
  }
}

bool Tokens::begin_line() {
  fetch();
  by_line_ = !next_.empty();
  taken_line_ = line_;
  return by_line_;
}

std::string_view Tokens::peek() {
  fetch();
  return by_line_ && line_ != taken_line_ ? std::string_view() : next_;
}

std::string_view Tokens::take() {
  if (peek().empty()) return {};
  taken_line_ = line_;
  return std::exchange(next_, {});
}

bool Tokens::take_if(std::string_view word) {
  if (word.empty() || peek() != word) return false;
  take();
  return true;
}

void Tokens::skip_line() {
  while (continues()) take();
}

void Tokens::end_line() {
  if (continues()) fail_next("the end of the line");
}

bool Tokens::continues() { return !peek().empty() && line_ == taken_line_; }

std::string_view Tokens::take_word(std::string_view what) {
  if (peek().empty()) fail_next(what);
  return take();
}

double Tokens::take_number(std::string_view what) {
  const std::optional<double> value = parse_number(peek());
  if (!value || std::abs(*value) > MAX_NUMBER)
    fail_next(fmt::format("{} (a number up to {:g} in magnitude)", what, MAX_NUMBER));
  take();
  return *value;
}

double Tokens::take_number(std::string_view what, double lo, double hi) {
  const std::optional<double> value = parse_number(peek());
  if (!value || *value < lo || *value > hi)
    fail_next(fmt::format("{} (a number from {:g} to {:g})", what, lo, hi));
  take();
  return *value;
}

int Tokens::take_count(std::string_view what, int lo, int hi) {
  const auto value = base::parse_number<int>(peek());
  if (!value || *value < lo || *value > hi)
    fail_next(fmt::format("{} (a whole number from {} to {})", what, lo, hi));
  take();
  return *value;
}

Vec Tokens::take_vec(std::string_view what) {
  const double x = take_number(what), y = take_number(what);
  return {x, y, take_number(what)};
}

Rgb Tokens::take_rgb(std::string_view what) {
  const auto [r, g, b] = take_vec(what);
  return {r, g, b};
}

void Tokens::fail(int line, std::string_view message) const {
  throw base::BadInput(fmt::format("{}:{}: {}", name_, line, message));
}

void Tokens::fail_next(std::string_view expected) {
  const std::string_view word = peek();
  if (!word.empty()) fail(line_, fmt::format("found {}, expected {}", base::quote(word), expected));
  if (by_line_) fail(taken_line_, fmt::format("found the end of the line, expected {}", expected));
  fail(line_, fmt::format("found the end of the file, expected {}", expected));
}

}  // namespace renderer

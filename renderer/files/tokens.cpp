#include "renderer/files/tokens.hpp"

#include <charconv>

#include "base/text.hpp"

namespace renderer {

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range && word.find("e-") != word.npos) return 0.0;
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

void Tokens::fetch() {
  constexpr std::string_view BLANKS = " \t\r\v\f", ENDS = " \t\r\v\f\n#";
  const auto find_end = [&](std::string_view ends) {
    return std::min(text_.find_first_of(ends, at_), text_.size());
  };
  while (next_.empty() && at_ < text_.size()) {
    if (text_[at_] == '\n') {
      if (++at_ < text_.size()) ++line_;
    } else if (text_[at_] == '#') {
      ++at_;
      const auto comment = base::trim(text_.substr(at_, find_end("\n") - at_));
      if (taken_line_ != line_ && is_statement_ && is_statement_(comment))
        next_ = text_.substr(at_ - 1, 1);
      else
        at_ = find_end("\n");
    } else if (BLANKS.find(text_[at_]) != BLANKS.npos) {
      ++at_;
    } else {
      next_ = text_.substr(at_, find_end(ENDS) - at_);
      at_ += next_.size();
    }
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

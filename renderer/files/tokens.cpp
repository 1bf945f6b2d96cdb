#include "renderer/files/tokens.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "renderer/scene/primitives.hpp"

namespace renderer {

namespace {

constexpr std::string_view BLANKS = " \t\r\v\f";

// A finite decimal number and nothing else. Whatever the locale.
std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range && word.find("e-") != word.npos) return 0.0;
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::string quote(std::string_view word) {
  constexpr std::size_t MAX = 40;
  std::string shown;
  for (const char c : word.substr(0, MAX))
    shown += c >= ' ' && c <= '~' ? std::string(1, c)
                                  : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return fmt::format("'{}{}'", shown, word.size() > MAX ? "..." : "");
}

std::string_view Tokens::peek() {
  while (next_.empty()) {
    at_ = text_.find_first_not_of(BLANKS, at_);
    if (at_ == text_.npos || text_[at_] == '#') {
      if (!std::getline(in_, text_)) {
        text_.clear();
        at_ = 0;
        return {};
      }
      ++line_;
      at_ = 0;
      continue;
    }
    const std::size_t end = std::min(text_.find_first_of(" \t\r\v\f#", at_), text_.size());
    next_ = text_.substr(at_, end - at_);
    at_ = end;
  }
  return next_;
}

std::string Tokens::take() {
  peek();
  taken_line_ = line_;
  return std::exchange(next_, {});
}

bool Tokens::continues() { return !peek().empty() && line_ == taken_line_; }

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
  const std::string_view word = peek();
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value < lo || value > hi)
    fail_next(fmt::format("{} (a whole number from {} to {})", what, lo, hi));
  take();
  return value;
}

Vec Tokens::take_vec(std::string_view what) {
  const double x = take_number(what), y = take_number(what);
  return {x, y, take_number(what)};
}

Rgb Tokens::take_rgb(std::string_view what) {
  const double r = take_number(what, 0, 1000), g = take_number(what, 0, 1000);
  return {r, g, take_number(what, 0, 1000)};
}

void Tokens::fail(int line, std::string_view message) const {
  throw base::BadInput(fmt::format("{}:{}: {}", name_, line, message));
}

void Tokens::fail_next(std::string_view expected) {
  const std::string_view word = peek();
  fail(std::max(line_, 1),
       fmt::format("found {}, expected {}", word.empty() ? "the end of the file" : quote(word),
                   expected));
}

}  // namespace renderer

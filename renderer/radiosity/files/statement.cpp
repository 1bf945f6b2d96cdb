#include "renderer/radiosity/files/statement.hpp"

#include <fmt/format.h>

namespace radiosity {

bool Statement::take_if(std::string_view word) {
  if (peek() != word || word.empty()) return false;
  tokens_.take();
  return true;
}

void Statement::fail_next(std::string_view expected) {
  if (tokens_.continues()) tokens_.fail_next(expected);
  fail(fmt::format("found the end of the line, expected {}", expected));
}

void Statement::need(std::string_view what) {
  if (!tokens_.continues()) fail_next(what);
}

std::string Statement::take_word(std::string_view what) {
  need(what);
  return tokens_.take();
}

double Statement::take_number(std::string_view what) {
  need(what);
  return tokens_.take_number(what);
}

int Statement::take_count(std::string_view what, int lo, int hi) {
  need(what);
  return tokens_.take_count(what, lo, hi);
}

Vec Statement::take_vec(std::string_view what) {
  const double x = take_number(what), y = take_number(what);
  return {x, y, take_number(what)};
}

renderer::Rgb Statement::take_rgb(std::string_view what) {
  const double r = take_number(what), g = take_number(what);
  return {r, g, take_number(what)};
}

void Statement::skip() {
  while (tokens_.continues()) tokens_.take();
}

void Statement::end() {
  if (tokens_.continues()) tokens_.fail_next("the end of the line");
}

}  // namespace radiosity

// What commands share to declare and read their options.
#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "experiments/laboratory/file/image_names.hpp"

namespace laboratory {

// "WxH", or "X,Y,WxH" for an area. Throws CLI::ValidationError.
template <std::size_t N>
std::array<int, N> parse_numbers(const std::string& option, const std::string& text,
                                 const char* form) {
  std::array<int, N> values{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < N; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const char separator = i + 2 == N ? 'x' : ',';
    const bool more = i + 1 < N;
    if (error != std::errc{} || (more ? next == end || *next != separator : next != end))
      throw CLI::ValidationError(option, fmt::format("found \"{}\", expected {}", text, form));
    at = next + 1;
  }
  return values;
}

// Sets width and height of `--size`, unless it is empty.
template <class Params>
void parse_size(const std::string& text, Params& params) {
  if (text.empty()) return;
  const auto v = parse_numbers<2>("--size", text, "WxH, such as 512x512");
  params.width = v[0];
  params.height = v[1];
}

// An option that sets `field` to the choice of a name.
template <class Enum>
void add_choice(CLI::App* command, const char* option, Enum& field, const Names<Enum>& names,
                const char* help) {
  const auto set = [&field, &names](const std::string& key) {
    field = std::ranges::find(names, key, &std::pair<std::string, Enum>::first)->second;
  };
  const auto standard = std::ranges::find(names, field, &std::pair<std::string, Enum>::second);
  command->add_option_function<std::string>(option, set, help)
      ->check(CLI::IsMember(keys_of(names)))
      ->option_text(fmt::format("{} [{}]", fmt::join(keys_of(names), "|"), standard->first));
}

}  // namespace laboratory

#pragma once
// Reading single values of a TOML file, with errors that say where, what was found and what was
// expected.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/image_names.hpp"
#include "renderer/shade.hpp"

namespace experiments {

// A value and where it stands.
struct Place {
  std::string origin;  // the file's name
  std::string key;     // "scene.objects"
  std::string folder;  // what paths are relative to
  const toml::node& node;

  // "farm.toml:12"
  std::string where() const;
  // Throws machine::InvalidInput.
  [[noreturn]] void refuse(const std::string& expected) const;
};

std::int64_t read_int(const Place& at, std::int64_t low, std::int64_t high);
double read_double(const Place& at, double low, double high);
bool read_bool(const Place& at);
std::string read_text(const Place& at);
// What a name stands for.
template <class Enum>
Enum read_name(const Place& at, const Names<Enum>& names) {
  const auto key = at.node.value_exact<std::string>();
  for (const auto& [name, value] : names)
    if (key == name) return value;
  at.refuse(fmt::format("one of {}", fmt::join(keys_of(names), ", ")));
}
// [x, y, width, height]
renderer::Area read_area(const Place& at);
// A name, or a path (it has an extension), made relative to the folder.
std::string read_source(const Place& at);
// The tables of [[key]].
std::vector<const toml::table*> read_tables(const Place& at);

}  // namespace experiments

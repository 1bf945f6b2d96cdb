#pragma once
// Reading single values of a TOML file, with errors that say where, what was found and what was
// expected.
#include <toml++/toml.h>

#include <algorithm>
#include <string>
#include <vector>

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
// The index of a text in `names`.
std::size_t read_choice(const Place& at, const std::vector<std::string>& names);
template <class Enum>
Enum read_name(const Place& at, const std::vector<std::string>& names) {
  return static_cast<Enum>(read_choice(at, names));
}
// [x, y, width, height]
renderer::Area read_area(const Place& at);
// A name, or a path (it has an extension), made relative to the folder.
std::string read_source(const Place& at);
// The tables of [[key]].
std::vector<const toml::table*> read_tables(const Place& at);

}  // namespace experiments

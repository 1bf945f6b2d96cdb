#pragma once
// Reading single values of a TOML file, with errors that say where, what was found and what was
// expected.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"

namespace laboratory {

// A value and where it stands.
struct Place {
  std::string origin;  // the file's name
  std::string key;     // "scene.objects"
  std::string folder;  // what paths are relative to
  const toml::node& node;

  // "farm.toml:12"
  std::string where() const;
  // Throws base::BadInput.
  [[noreturn]] void refuse(const std::string& expected) const;
};

std::int64_t read_int(const Place& at, std::int64_t low, std::int64_t high);
double read_double(const Place& at, double low, double high);
bool read_bool(const Place& at);
std::string read_text(const Place& at);
// What a name stands for.
template <class Enum>
Enum read_name(const Place& at, const base::Names<Enum>& names) {
  const auto key = at.node.value_exact<std::string>();
  for (const auto& [name, value] : names)
    if (key == name) return value;
  std::vector<std::string> known;
  for (const auto& [name, value] : names) known.push_back(name);
  at.refuse(fmt::format("one of {}", fmt::join(known, ", ")));
}
std::vector<std::string> read_texts(const Place& at);
// A number for every link, or a list of [a, b, number], processors as the topology numbers them.
void read_switches(const Place& at, int& all, std::vector<std::array<int, 3>>& between);
// A name, or a path (it has an extension), which is found from the folder.
base::Source read_source(const Place& at);
// A file's name, found from the folder; "" for none.
base::Source read_file_name(const Place& at);
// A value for a field of this domain, still to be checked: texts become sources where they name
// files.
base::Scalar read_scalar(const Place& at, const base::Domain& domain);
// The tables of [[key]].
std::vector<const toml::table*> read_tables(const Place& at);

// A value as TOML spells it.
std::string to_toml(const toml::node& node);
// Every key of a point, dotted, in the order of names: not those of [sweep], [let], [[check]]
// and what the report shows.
void for_each_key(const toml::table& file,
                  const std::function<void(const std::string& key, const toml::node&)>& visit);

}  // namespace laboratory

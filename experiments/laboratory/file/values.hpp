#pragma once
// Typed access to values of a TOML file, and binding of keys to members. Errors give the position,
// the value found and the expected one.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/fields.hpp"
#include "base/text.hpp"
#include "base/toml.hpp"

namespace laboratory {

/// Quotes a string as TOML does.
std::string spell_text(const std::string& text);

using base::to_toml;

/// A TOML value with its position.
struct Place {
  std::string origin;  ///< name of the file
  std::string key;     ///< dotted key, "scene.objects"
  std::string folder;  ///< folder that paths are relative to
  const toml::node& node;
  std::string owner = {};  ///< prefix of the key in error messages, "[[fault]] 2: "

  /// The place of a value inside this table or list.
  Place inside(std::string_view its_key, const toml::node& its_node) const {
    return {origin, std::string(its_key), folder, its_node, owner};
  }
  /// File and line, "farm.toml:12".
  std::string where() const;
  /// Throws BadInput with the value found and the given expectation.
  [[noreturn]] void refuse(const std::string& expected) const;
};

// Readers of one value. They throw BadInput for a value of another type or out of range.
std::int64_t read_int(const Place& at, std::int64_t low, std::int64_t high);
double read_double(const Place& at, double low, double high);
std::string read_text(const Place& at);
/// Reads a list of N integers from 0 to `high`; none if the node is not such a list.
template <std::size_t N>
std::optional<std::array<int, N>> find_ints(const toml::node& node, int high) {
  const auto* list = node.as_array();
  if (!list || list->size() != N) return std::nullopt;
  std::array<int, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto number = (*list)[i].value_exact<std::int64_t>();
    if (!number || *number < 0 || *number > high) return std::nullopt;
    numbers[i] = static_cast<int>(*number);
  }
  return numbers;
}
/// Reads the name of a file, relative to the folder; "" for none.
base::Source read_file_name(const Place& at);
/// Reads a value for a field of this domain without checking its range. Strings that name files
/// become sources.
base::Scalar read_scalar(const Place& at, const base::Domain& domain);
/// The tables of [[key]]. Throws BadInput for an empty list unless `may_be_empty`.
std::vector<const toml::table*> tables_of(const Place& at, bool may_be_empty = false);

// Readers selected by the type of the member. A list of strings must not be empty.
void read(const Place& at, std::string& text);
void read(const Place& at, std::vector<std::string>& texts);
void read(const Place& at, bool& flag);
inline void read(const Place& at, std::optional<bool>& flag) { read(at, flag.emplace()); }
/// Reads a name, or a path with an extension, relative to the folder.
void read(const Place& at, base::Source& source);

/// A key of a table, bound to the member it sets.
template <class Target>
struct Binding {
  std::string key, help;
  std::function<void(Target&, const Place&)> set;
};
template <class Target>
using Bindings = std::vector<Binding<Target>>;

template <class Target, class Member>
Binding<Target> bind_key(const std::string& key, Member Target::*member, const std::string& help) {
  return {key, help, [member](Target& target, const Place& at) { read(at, target.*member); }};
}
/// Binds a number from `low` to `high`.
template <class Target, class Member>
Binding<Target> bind_number(const std::string& key, Member Target::*member, double low, double high,
                            const std::string& help) {
  return {key, help,
          [=](Target& target, const Place& at) { target.*member = read_double(at, low, high); }};
}
/// Binds a member to a key whose value is one of `names`.
template <class Target, class Member>
Binding<Target> bind_name(const std::string& key, Member Target::*member,
                          const base::Names<Member>& names, const std::string& help) {
  return {key, help, [=](Target& target, const Place& at) {
            const auto text = at.node.value_exact<std::string>();
            const auto found =
                std::ranges::find(names, text, &base::Names<Member>::value_type::first);
            if (found == names.end())
              at.refuse(fmt::format("one of {}", fmt::join(names | std::views::keys, ", ")));
            target.*member = found->second;
          }};
}

/// Throws BadInput for an unknown key, with the nearest valid one. For `section.KEY`, it prefers a
/// key that ends in KEY.
[[noreturn]] void refuse_key(const Place& at, const std::vector<std::string>& known);

template <class Target>
void bind_one(Target& target, const Bindings<Target>& bindings, const Place& at) {
  const auto found = std::ranges::find(bindings, at.key, &Binding<Target>::key);
  if (found != bindings.end()) return found->set(target, at);
  std::vector<std::string> known;
  for (const auto& b : bindings) known.push_back(b.key);
  refuse_key(at, known);
}

/// Sets the members bound to the keys of a table.
template <class Target>
void bind_all(Target& target, const Bindings<Target>& bindings, const toml::table& table,
              const Place& at) {
  for (auto&& [key, node] : table) bind_one(target, bindings, at.inside(key.str(), node));
}

/// Visits every key of a point by its dotted name, sorted by name. Skips [sweep], [let], [[check]]
/// and the tables for the report.
void for_each_key(const toml::table& file,
                  const std::function<void(const std::string& key, const toml::node&)>& visit);

}  // namespace laboratory

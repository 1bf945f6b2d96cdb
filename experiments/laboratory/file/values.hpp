#pragma once
// Typed access to values of a TOML file, and their assignment to declared fields. Error messages
// give the position, the value found and the value expected.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// A TOML value with its position in a file, for error messages.
struct Place {
  std::string origin;  ///< name of the file
  std::string key;     ///< dotted key, "scene.objects"
  std::string folder;  ///< folder that paths in the value are relative to
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

/// Reads a value of the given domain. A string that names a file becomes a source. Throws BadInput
/// for a value outside the domain. If the domain is a choice, the message suggests the nearest
/// valid value.
base::Scalar read_value(const Place& at, const base::Domain& domain);
/// Reads the text of an expression, which may also be written as a number.
std::string read_expression(const Place& at);

/// Reads a list of rows. Each row has N whole numbers from 0 to `high`. Returns no value if `value`
/// is anything else.
template <std::size_t N>
std::optional<std::vector<std::array<int, N>>> find_rows(const base::Scalar& value, int high) {
  std::vector<std::array<int, N>> all;
  if (value == base::Scalar(std::vector<double>())) return all;
  const auto* rows = std::get_if<std::vector<std::vector<double>>>(&value);
  if (!rows) return std::nullopt;
  for (const auto& row : *rows) {
    const auto is_whole = [&](double n) { return n >= 0 && n <= high && n == std::floor(n); };
    if (row.size() != N || !std::ranges::all_of(row, is_whole)) return std::nullopt;
    std::ranges::transform(row, all.emplace_back().begin(), [](double n) { return int(n); });
  }
  return all;
}
/// Throws BadInput unless the value is a list of tables, written [[key]]. An empty list is an error
/// unless `may_be_empty`.
void check_tables(const Place& at, bool may_be_empty = false);

/// Throws BadInput for an unknown key, with the nearest valid key. Prefers a key that ends in KEY
/// if the unknown key is `section.KEY`.
[[noreturn]] void refuse_key(const Place& at, const std::vector<std::string>& known);

/// Sets the fields that a table names to its values. Throws BadInput for an unknown key.
template <class P>
void assign_all(P& params, const base::Fields<P>& fields, const toml::table& table,
                const Place& at) {
  for (auto&& [key, node] : table) {
    const Place its{at.origin, std::string(key.str()), at.folder, node, at.owner};
    const auto field = std::ranges::find(fields, its.key, &base::Field<P>::name);
    if (field == fields.end()) {
      std::vector<std::string> known;
      for (const auto& f : fields) known.push_back(f.name);
      refuse_key(its, known);
    }
    if (!field->write(field->place(params), read_value(its, field->domain)))
      its.refuse(field->domain.describe());
  }
}

}  // namespace laboratory

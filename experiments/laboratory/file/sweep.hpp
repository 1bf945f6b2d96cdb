#pragma once
// [sweep] of an experiment file: which axes span it, and their values.
#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

// Axes that go together: one, but for "workers, height" = [[1, 16], ...].
using Coupled = std::vector<Axis>;

// "workers, height" however it is spelled.
std::string join_names(std::string_view name);

// Adds the names of the axes that are new, in the order of the file; names with dots may stand
// there with or without quotes. (TOML tables are sorted by name.)
void add_names(std::vector<std::string>& order, toml::table& file, const std::string& origin);

// The axes of a file; `order` has their names. Throws base::BadInput for unknown axes, those that
// are there twice, and values that are no list of one for each.
std::vector<Coupled> read_axes(const toml::table& file, const std::vector<std::string>& order,
                               const Programs& in_play, const std::string& origin);

// The whole file as TOML, with the axes in the order of the sweep: a table sorts them by name.
std::string resolve(const toml::table& file, const std::vector<Coupled>& axes,
                    const Programs& in_play);

// How many points they span. Throws base::BadInput for more than a run can hold.
std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path);

}  // namespace laboratory

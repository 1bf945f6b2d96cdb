#pragma once
// [sweep] of an experiment file: which axes span it, and their values.
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

/// Axes that go together: one, but for "workers, height" = [[1, 16], ...].
using Coupled = std::vector<Axis>;

/// Spells "workers, height" in one way, however it is spelled.
std::string join_names(std::string_view name);

/// Adds the names of the axes that are new, in the order of the file, since TOML sorts a table by
/// its names. Names with dots may stand there with or without quotes.
void add_names(std::vector<std::string>& order, toml::table& file, const std::string& origin);

/// Reads the axes of a file; `order` has their names. Throws BadInput for unknown axes, those that
/// are there twice, and values that are no list of one for each.
std::vector<Coupled> read_axes(const toml::table& file, const std::vector<std::string>& order,
                               const Programs& in_play, const std::string& origin);

/// The whole file as TOML, with the axes in the order of the sweep.
std::string resolve(const toml::table& file, const std::vector<Coupled>& axes,
                    const Programs& in_play);

/// The number of points that they span. Throws BadInput for more than a run can hold.
std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path);

}  // namespace laboratory

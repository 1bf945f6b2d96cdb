#pragma once
// [sweep] of an experiment file: its axes and their values.
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

/// Coupled axes, as in "workers, height" = [[1, 16], ...]. A single axis is a list of one.
using Coupled = std::vector<Axis>;

/// Normalises the spelling of coupled names such as "workers, height".
std::string join_names(std::string_view name);

/// Appends the names of new axes in file order, which the TOML library does not keep. Names with
/// dots may be quoted or not.
void add_names(std::vector<std::string>& order, toml::table& file, const std::string& origin);

/// Reads the axes of a file; `order` lists their names. Throws BadInput for unknown or repeated
/// axes, and for values that are not a list with one value for each axis.
std::vector<Coupled> read_axes(const toml::table& file, const std::vector<std::string>& order,
                               const Programs& in_play, const std::string& origin);

/// Formats the whole file as TOML, with the axes in the order of the sweep.
std::string resolve(const toml::table& file, const std::vector<Coupled>& axes,
                    const Programs& in_play);

/// The number of points in the sweep. Throws BadInput if it exceeds the limit for a run.
std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path);

}  // namespace laboratory

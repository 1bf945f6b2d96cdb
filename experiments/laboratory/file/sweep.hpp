#pragma once
// [sweep] of an experiment file: its axes and their values.
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

/// Normalises blanks and quotes in the names of axes that change together: "workers, height".
std::string join_names(std::string_view name);

/// Appends the names of new axes to `order`, in the order of the file, which the TOML library does
/// not keep. Names with dots may be quoted or not.
void add_names(std::vector<std::string>& order, toml::table& file, const std::string& origin);

/// Reads the names and values of the axes of a file, in the order of `order`. Throws BadInput if
/// the values are not a list with one value for each axis.
std::vector<Coupled> read_axes(const std::shared_ptr<const toml::table>& file,
                               const std::vector<std::string>& order, const std::string& origin);

/// Finds the key that each axis sets, and shortens the name of the axis. Throws BadInput for
/// unknown or repeated axes.
void name_axes(std::vector<Coupled>& axes, const Programs& in_play, const std::string& origin);

/// Replaces the key run.repetitions of `file` by an axis with that number of consecutive seeds. The
/// first seed is the program's own. If a program has several seeds, they become axes that change
/// together. One repetition needs no axis. Appends the name of the axis to `order`. `experiment`
/// has the axes and keys of the same file. Returns true if the file had the key, so that axes and
/// keys must be read again. Throws BadInput if the programs have no seed that has an effect, or if
/// a seed is an axis already.
bool expand_repetitions(toml::table& file, std::vector<std::string>& order,
                        const ExperimentFile& experiment, const Programs& in_play);

/// The values of all axes at the point with index `point`, from 0. The last axis varies fastest.
std::vector<Coordinate> find_coordinates(const std::vector<Coupled>& axes, std::size_t point);

/// The number of points in the sweep. Throws BadInput if it exceeds the limit for a run.
std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path);

}  // namespace laboratory

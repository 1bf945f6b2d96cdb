#pragma once
// [sweep] of an experiment file: its axes and their values.
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

/// Normalises the spelling of coupled names such as "workers, height".
std::string join_names(std::string_view name);

/// Appends the names of new axes in file order, which the TOML library does not keep. Names with
/// dots may be quoted or not.
void add_names(std::vector<std::string>& order, toml::table& file, const std::string& origin);

/// Reads the names and values of the axes of a file; `order` lists the names. Throws BadInput for
/// values that are not a list with one value for each axis.
std::vector<Coupled> read_axes(const std::shared_ptr<const toml::table>& file,
                               const std::vector<std::string>& order, const std::string& origin);

/// Finds the keys of the axes, and shortens the names. Throws BadInput for unknown or repeated
/// axes.
void name_axes(std::vector<Coupled>& axes, const Programs& in_play, const std::string& origin);

/// Replaces the key run.repetitions of `file` by an axis of as many consecutive seeds, starting
/// with the program's. A program with several seeds gets coupled axes. One repetition needs no
/// axis. Appends the name of the axis to `order`. `experiment` has the axes and keys of the same
/// file. Returns true if the key was there, so that axes and keys must be read again. Throws
/// BadInput if the programs have no seed or none that has an effect, or if a seed is an axis
/// already.
bool expand_repetitions(toml::table& file, std::vector<std::string>& order,
                        const ExperimentFile& experiment, const Programs& in_play);

/// The values of all axes at the point with number `point`. The last axis varies fastest.
std::vector<Coordinate> find_coordinates(const std::vector<Coupled>& axes, std::size_t point);

/// The number of points in the sweep. Throws BadInput if it exceeds the limit for a run.
std::size_t count_points(const std::vector<Coupled>& axes, const std::string& path);

}  // namespace laboratory

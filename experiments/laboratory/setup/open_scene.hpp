#pragma once
// Loads scenes and rooms, with warnings on standard error.
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/radiosity/files/load_room.hpp"

namespace laboratory {

/// Prints each sentence on standard error, as "tlab: warning: ...".
void warn(const std::vector<std::string>& sentences);

/// Loads a scene as renderer::load_scene() does. Warns of features in the file that the loader
/// leaves out.
renderer::Scene open_scene(const std::string& source, int frame = 0);

/// Loads a room as radiosity::load_room() does. Warns of features in the file that the loader
/// leaves out.
radiosity::Room open_room(const std::string& path);

/// Warns of features in the OBJ files of an experiment that the loader leaves out, once for each
/// file. Ignores errors in the files, because the programs report these.
void warn_of_scenes(const ExperimentFile& file);

}  // namespace laboratory

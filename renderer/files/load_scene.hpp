#pragma once
// Loads scenes from files, or makes them with a generator.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/nff.hpp"
#include "renderer/files/text/left_out.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// Makes a scene. `source` is a generator and its number ("spheres:800", "hills:20000"), or the
/// path of an .nff or .obj file. `frame` is the number of the frame, from 0. `left_out`, if given,
/// counts the parts of the file that are ignored. Throws BadInput as parse_scene() does, and if the
/// file cannot be read. For any other `source`, throws BadInput that lists the valid ones.
Scene load_scene(const std::string& source, int frame = 0, LeftOut* left_out = nullptr);

/// True if the source is a file rather than a generator. A file may change between runs.
bool is_scene_file(std::string_view source);

/// Parses one frame of an NFF scene, or of an OBJ scene if `name` ends in .obj. `frame` counts from
/// 0. Objects and view are placed as at the time `frame` + T0, when the shutter opens. They move
/// linearly until the time `frame` + T1, when it closes (see renderer/files/nff.hpp). Paths of
/// other files are relative to the folder of `name`. Throws BadInput "name:line: found ...,
/// expected ...".
Scene parse_scene(std::string_view text, const std::string& name, int frame = 0,
                  LeftOut* left_out = nullptr);

/// Calls the functions of `target` for the statements of a scene text. Translates OBJ statements to
/// NFF statements. Throws BadInput as parse_scene() does.
void read_scene(std::string_view text, const std::string& name, NffTarget& target,
                LeftOut* left_out = nullptr);

/// Calls the functions of `target` for the parts of a scene, as they are when the shutter opens.
/// The scene must have no textures. The corners of polygons may change by rounding.
void tell(const Scene& scene, NffTarget& target);

/// Lists the other files that a scene file names, in the order of the file. Returns none for a
/// generator. Throws BadInput as load_scene() does.
std::vector<std::string> find_files(const std::string& source);

}  // namespace renderer

#pragma once
// Scenes by name: made by a generator, or read from a file.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/nff.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// A generator with its number, such as "spheres:800" or "hills:20000", or the path of an .nff or
/// .obj file. BadInput as parse_scene(), if the file cannot be read, and for anything else, naming
/// what is valid.
Scene load_scene(const std::string& source, int frame = 0);

/// Whether a source is read from a file, and its bytes may change.
bool is_scene_file(std::string_view source);

/// Reads an NFF scene, or one of an OBJ where `name` ends in .obj, as it is in a frame of an
/// animation: objects and view are where they are when the shutter opens, at the time frame + T0,
/// and move evenly to where they are when it closes, at frame + T1. Other files that it names are
/// looked for beside `name`. BadInput "name:line: found ..., expected ...".
Scene parse_scene(std::string_view text, const std::string& name, int frame = 0);

/// Tells `target` a text of either format: an OBJ in the words of an NFF. BadInput likewise.
void read_scene(std::string_view text, const std::string& name, NffTarget& target);

/// Tells `target` a scene without textures, as it is when the shutter opens. Corners of polygons
/// can be a rounding off those that it was made of.
void tell(const Scene& scene, NffTarget& target);

/// Paths of the further files that a scene's file names, in its order; none of a generator's.
/// BadInput as load_scene().
std::vector<std::string> find_files(const std::string& source);

}  // namespace renderer

#pragma once
// Scenes by name, from a generator or from a file.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/nff.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// Makes a scene from a generator with its number ("spheres:800", "hills:20000") or from the path
/// of an .nff or .obj file. BadInput as parse_scene(), if the file cannot be read, and for any
/// other source; this message lists the valid ones.
Scene load_scene(const std::string& source, int frame = 0);

/// True if a source is a file, so that its content may change.
bool is_scene_file(std::string_view source);

/// Parses one frame of an NFF scene, or of an OBJ scene if `name` ends in .obj. Objects and view
/// start where they are when the shutter opens, at time frame + T0. They move linearly until it
/// closes, at frame + T1. Other files are looked for beside `name`. BadInput "name:line: found ...,
/// expected ...".
Scene parse_scene(std::string_view text, const std::string& name, int frame = 0);

/// Sends `target` the statements of a text in either format, OBJ as NFF. BadInput as above.
void read_scene(std::string_view text, const std::string& name, NffTarget& target);

/// Sends `target` a scene without textures, as it is when the shutter opens. Polygon corners can
/// differ by rounding from those that the scene was made from.
void tell(const Scene& scene, NffTarget& target);

/// Paths of the further files that a scene's file names, in its order; none for a generator.
/// BadInput as load_scene().
std::vector<std::string> find_files(const std::string& source);

}  // namespace renderer

#pragma once
// Loading of scenes from generators and files.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/nff.hpp"
#include "renderer/files/text/left_out.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// Makes a scene from the name and number of a generator ("spheres:800", "hills:20000"), or from
/// the path of an .nff or .obj file. Throws BadInput as parse_scene() does, and if the file cannot
/// be read. For any other `source`, the message of BadInput lists the valid ones. `left_out`, if
/// given, counts the parts of a file that cannot be read or that scenes do not have.
Scene load_scene(const std::string& source, int frame = 0, LeftOut* left_out = nullptr);

/// True if the source is a file, whose content may change between runs.
bool is_scene_file(std::string_view source);

/// Parses one frame of an NFF scene, or of an OBJ scene if `name` ends in .obj. Objects and view
/// are placed as at the time when the shutter opens (`frame` + T0), and move linearly until the
/// shutter closes (`frame` + T1). Paths of other files are relative to the folder of `name`. Throws
/// BadInput "name:line: found ..., expected ...".
Scene parse_scene(std::string_view text, const std::string& name, int frame = 0,
                  LeftOut* left_out = nullptr);

/// Sends the statements of a scene text to `target`. Statements of OBJ are translated to NFF.
/// Throws BadInput as parse_scene() does.
void read_scene(std::string_view text, const std::string& name, NffTarget& target,
                LeftOut* left_out = nullptr);

/// Sends a scene to `target` as it is when the shutter opens. The scene must have no textures.
/// Rounding may change the corners of polygons.
void tell(const Scene& scene, NffTarget& target);

/// Lists the files that a scene file refers to, in the order of the file; none for a generator.
/// Throws BadInput as load_scene() does.
std::vector<std::string> find_files(const std::string& source);

}  // namespace renderer

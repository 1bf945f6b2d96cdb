#pragma once
// Path of a moving object or camera, read from a file.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

struct PathRow {
  double time = 0;  ///< time in frames, from the start of frame 0
  Vec place, target;
};

/// The rows of a path: at least one, in the order of increasing times.
using Path = std::vector<PathRow>;

/// Loads a path from a text file with one row per line: `T X Y Z`, or, with `has_target`, `T FROMX
/// FROMY FROMZ ATX ATY ATZ`. T is a time in frames; the rest are positions in scene units. Blanks
/// or commas separate numbers, and '#' starts a comment. The first line may be a header that begins
/// with `T`. Throws BadInput "path:line: found ..., expected ...", or "path: ..." if the file is
/// unreadable.
Path load_path(const std::string& path, bool has_target);
/// Parses a path from a text in the format of load_path(). `name` is the file's name in messages.
Path parse_path(std::string text, const std::string& name, bool has_target);

/// Returns the positions on the path at a time in frames. Interpolates linearly between rows.
/// Before the first row and after the last row, the positions are constant.
PathRow eval_path(const Path& path, double time);

}  // namespace renderer

#pragma once
// Motion path from a file. Each row has a time in frames and a position.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

struct PathRow {
  double time = 0;  ///< time in frames
  Vec place, target;
};

/// Rows of a path, at least one, with increasing times.
using Path = std::vector<PathRow>;

/// Loads a path from a file with one row per line: `T X Y Z`, or with `has_target` `T FROMX FROMY
/// FROMZ ATX ATY ATZ`. Blanks or commas separate numbers, and '#' starts a comment. The first line
/// may be a header that begins with `T`. Throws BadInput "path:line: found ..., expected ...", or
/// "path: ..." if the file is unreadable.
Path load_path(const std::string& path, bool has_target);
/// Parses a path from a text in the format of load_path().
Path parse_path(std::string text, const std::string& name, bool has_target);

/// Evaluates the path at a time. Interpolates linearly between rows. Before the first row and after
/// the last, the path is constant.
PathRow eval_path(const Path& path, double time);

}  // namespace renderer

#pragma once
// Positions over time, from a file: each row has a time in frames and a position.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

struct PathRow {
  double time = 0;  ///< frames
  Vec place, target;
};

/// One or more rows with increasing times.
using Path = std::vector<PathRow>;

/// Loads rows of `T X Y Z`, or with `has_target` of `T FROMX FROMY FROMZ ATX ATY ATZ`, one a line.
/// Blanks or commas separate numbers, and '#' starts a comment. The first line may be a header that
/// begins with `T`. BadInput "path:line: found ..., expected ..."; "path: ..." if unreadable.
Path load_path(const std::string& path, bool has_target);
/// Parses the same from a text.
Path parse_path(std::string text, const std::string& name, bool has_target);

/// The path's row at a time: linear between rows, constant before the first and after the last row.
PathRow eval_path(const Path& path, double time);

}  // namespace renderer

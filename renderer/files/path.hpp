#pragma once
// Places over time, from a file: a row is a time in frames and where something is then.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

struct PathRow {
  double time = 0;  ///< frames
  Vec place, target;
};

/// One row or more, their times increasing.
using Path = std::vector<PathRow>;

/// Rows of `T X Y Z`, or with `has_target` of `T FROMX FROMY FROMZ ATX ATY ATZ`, one a line,
/// numbers separated by blanks or commas; '#' starts a comment, and the first line may be a header
/// that begins with `T`. BadInput "path:line: found ..., expected ..."; "path: ..." if it cannot be
/// read.
Path load_path(const std::string& path, bool has_target);
/// The same of a text.
Path parse_path(std::string text, const std::string& name, bool has_target);

/// Where the path leads at a time: linear between two rows, and as the first or the last row has it
/// before and after.
PathRow eval_path(const Path& path, double time);

}  // namespace renderer

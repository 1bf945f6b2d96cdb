#include "renderer/files/path.hpp"

#include <algorithm>

#include "base/whole_file.hpp"
#include "renderer/files/text/tokens.hpp"

namespace renderer {

Path parse_path(std::string text, const std::string& name, bool has_target) {
  std::ranges::replace(text, ',', ' ');
  Tokens tokens(text, name);
  Path path;
  for (bool is_first = true; tokens.begin_line(); is_first = false) {
    if (is_first && tokens.take_if("T")) {
      tokens.skip_line();
      continue;
    }
    PathRow row;
    row.time = tokens.take_number("a time in frames");
    row.place = tokens.take_vec(has_target ? "the view point" : "a displacement");
    if (has_target) row.target = tokens.take_vec("the point that the camera looks at");
    tokens.end_line();
    if (!path.empty() && !(row.time > path.back().time))
      tokens.fail(tokens.line(), fmt::format("found the time {}, expected more than {}", row.time,
                                             path.back().time));
    path.push_back(row);
  }
  if (path.empty()) tokens.fail_next("a row of numbers");
  return path;
}

Path load_path(const std::string& path, bool has_target) {
  return parse_path(base::read_text(path), path, has_target);
}

PathRow eval_path(const Path& path, double time) {
  const auto next = std::ranges::upper_bound(path, time, {}, &PathRow::time);
  if (next == path.begin()) return path.front();
  if (next == path.end()) return path.back();
  const PathRow &a = *std::prev(next), &b = *next;
  const double share = (time - a.time) / (b.time - a.time);
  return {time, a.place + share * (b.place - a.place), a.target + share * (b.target - a.target)};
}

}  // namespace renderer

#include "experiments/laboratory/setup/open_scene.hpp"

#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {

void warn(const std::vector<std::string>& sentences) {
  for (const auto& sentence : sentences) complain("warning: " + sentence);
}

renderer::Scene open_scene(const std::string& source, int frame) {
  renderer::LeftOut left_out;
  auto scene = renderer::load_scene(source, frame, &left_out);
  warn(left_out.describe_all(source));
  return scene;
}

radiosity::Room open_room(const std::string& path) {
  renderer::LeftOut left_out;
  auto room = radiosity::load_room(path, &left_out);
  warn(left_out.describe_all(path));
  return room;
}

void warn_of_scenes(const ExperimentFile& file) {
  std::set<std::string> seen;
  for (const auto& point : file.points)
    for (const auto& path : files_of(point.experiment)) {
      if (!path.ends_with(".obj") || !seen.insert(path).second) continue;
      renderer::LeftOut left_out;
      try {
        renderer::load_scene(path, 0, &left_out);
      } catch (const base::BadInput&) {
        continue;
      }
      warn(left_out.describe_remarks());
    }
}

}  // namespace laboratory

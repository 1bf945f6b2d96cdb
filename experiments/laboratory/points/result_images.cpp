#include "experiments/laboratory/points/result_images.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "base/errors.hpp"
#include "experiments/laboratory/host/carry.hpp"
#include "experiments/laboratory/points/pattern_images.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// The image does not depend on topology, number of processors or timing.
void check_images(const ExperimentFile& file, const Results& results) {
  std::map<std::string, std::string> images;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].is_null() || !is_complete(results[i])) continue;
    const auto image = results[i]["image"].get<std::string>();
    const auto [known, added] = images.emplace(image_key(file.points[i].experiment), image);
    base::check_equal("image of one scene from another machine", image, known->second);
  }
}

// Different by a number where they clash.
std::string make_stem(const Experiment& experiment, std::set<std::string>& known) {
  const auto name = image_name(experiment);
  auto stem = name;
  for (int n = 2; !known.insert(stem).second; ++n) stem = fmt::format("{}-{}", name, n);
  return stem;
}

ordered_json place_key_images(const ordered_json& files, const fs::path& records,
                              const fs::path& folder, const std::string& stem) {
  ordered_json placed = ordered_json::array();
  for (const auto& image : files) {
    const auto name = fmt::format("{}-stage{}.png", stem, placed.size() + 1);
    carry_file(records / image["file"].get<std::string>(), folder / name);
    placed.push_back({{"path", name}, {"at_s", image["at_s"]}});
  }
  return placed;
}

}  // namespace

std::vector<std::string> place_images(const ExperimentFile& file, Results& results,
                                      const fs::path& records, const fs::path& folder) {
  std::vector<std::string> images(results.size());
  if (!is_farm(file)) {
    place_pattern_images(file, results, records, folder);
    return images;
  }
  check_images(file, results);
  std::map<std::string, std::string> stems;  // of equal images
  std::set<std::string> known, with_key_images;
  for (std::size_t i = 0; i < results.size(); ++i) {
    auto& result = results[i];
    if (result.is_null() || is_failed(result)) continue;
    const Experiment& e = file.points[i].experiment;
    const auto key = image_key(e) + stages_key(e);
    if (!stems.contains(key)) {
      stems[key] = make_stem(e, known);
      images[i] = stems[key] + ".png";
      carry_file(records / result["image"].get<std::string>(), folder / images[i]);
    }
    const ordered_json files = std::exchange(result["key_images"], ordered_json::array());
    if (!files.empty() && with_key_images.insert(key).second)
      result["key_images"] = place_key_images(files, records, folder, stems[key]);
  }
  return images;
}

}  // namespace laboratory

#include "experiments/laboratory/points/pattern_images.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "experiments/laboratory/host/carry.hpp"
#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/try_twice.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string save_by_content(const std::function<void(const std::string& path)>& save,
                            const fs::path& folder, const std::string& extension) {
  std::string name;
  try_twice([&] {
    fs::create_directories(folder);
    const auto partial = folder / fmt::format(".image-{}{}", getpid(), extension);
    save(partial.string());
    name = hash_of(read_file(partial)) + extension;
    fs::rename(partial, folder / name);
  });
  return name;
}

// An image, and who has it: two points whose images are equal share one.
struct Shared {
  std::vector<std::size_t> points;
  std::string stem, caption;
};
using Key = std::array<std::string, 3>;  // name, content, content of all its range

Key key_of(const ordered_json& image) {
  return {image["name"].get<std::string>(), image["file"].get<std::string>(),
          image.value("exr", "")};
}

// The axes that all of these points agree on, and not all points of the file.
std::vector<Coordinate> find_distinction(const ExperimentFile& file,
                                         const std::vector<std::size_t>& points) {
  std::vector<Coordinate> found;
  const auto& first = file.points[points[0]].at;
  for (std::size_t axis = 0; axis < first.size(); ++axis) {
    const auto has_it = [&](const Point& point) { return point.at[axis].toml == first[axis].toml; };
    const bool is_theirs =
        std::ranges::all_of(points, [&](std::size_t i) { return has_it(file.points[i]); });
    if (is_theirs && !std::ranges::all_of(file.points, has_it)) found.push_back(first[axis]);
  }
  return found;
}

// Letters, digits and single dashes.
std::string make_stem(const std::string& text) {
  std::string stem;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.')
      stem += c;
    else if (!stem.ends_with('-'))
      stem += '-';
  return stem;
}

void name_image(const ExperimentFile& file, const std::string& name, Shared& image,
                std::set<std::string>& known) {
  std::string stem = "image-" + name;
  image.caption = name;
  for (const auto& at : find_distinction(file, image.points)) {
    const auto cell = to_value(at);
    const auto value = to_string(cell);
    stem += "-" + (as_number(cell) ? value : fs::path(value).stem().string());
    image.caption += fmt::format(", {} = {}", at.axis, value);
  }
  stem = make_stem(stem);
  auto unique = stem;
  for (int n = 2; !known.insert(unique).second; ++n) unique = fmt::format("{}-{}", stem, n);
  image.stem = unique;
}

std::map<Key, Shared> find_shared(const ExperimentFile& file, const Results& results) {
  std::vector<Key> order;
  std::map<Key, Shared> shared;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].is_null() || !results[i].contains("images")) continue;
    for (const auto& image : results[i]["images"]) {
      auto& points = shared[key_of(image)].points;
      if (points.empty()) order.push_back(key_of(image));
      points.push_back(i);
    }
  }
  std::set<std::string> known;
  for (const auto& key : order) name_image(file, key[0], shared[key], known);
  return shared;
}

}  // namespace

ordered_json save_images(const std::vector<programs::Image>& images, const fs::path& folder) {
  ordered_json saved = ordered_json::array();
  for (const auto& image : images) {
    ordered_json entry{{"name", image.name}, {"file", save_by_content(image.save, folder, ".png")}};
    if (image.save_exr) entry["exr"] = save_by_content(image.save_exr, folder, ".exr");
    if (image.at_s) entry["at_s"] = *image.at_s;
    saved.push_back(entry);
  }
  return saved;
}

void place_pattern_images(const ExperimentFile& file, Results& results, const fs::path& records,
                          const fs::path& folder) {
  const auto shared = find_shared(file, results);
  for (auto& result : results) {
    if (result.is_null() || !result.contains("images")) continue;
    for (auto& image : result["images"]) {
      const Shared& placed = shared.at(key_of(image));
      const auto place = [&](const char* source, const std::string& name) {
        if (!fs::exists(folder / name))
          carry_file(records / image[source].get<std::string>(), folder / name);
        return name;
      };
      image["path"] = place("file", placed.stem + ".png");
      if (image.contains("exr")) image["exr"] = place("exr", placed.stem + ".exr");
      image["caption"] = placed.caption;
      if (image.contains("at_s"))
        image["caption"] =
            fmt::format("{}, after {:.2f} s", placed.caption, image["at_s"].get<double>());
      image.erase("file");
    }
  }
}

}  // namespace laboratory

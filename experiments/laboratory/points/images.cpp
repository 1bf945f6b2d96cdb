#include "experiments/laboratory/points/images.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "base/partial_name.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

std::string save_by_content(const std::function<void(const std::string& path)>& save,
                            const fs::path& folder, const std::string& extension) {
  std::string name;
  try_twice([&] {
    make_folders(folder);
    const auto name_of_process = base::make_partial_name("image", "partial", getpid());
    const auto partial = folder / fmt::format("{}-{}", name_of_process, extension);
    save(partial.string());
    name = hash_of(base::read_own_text(partial)) + extension;
    fs::rename(partial, folder / name);
  });
  return name;
}

// An image, and the points whose results have this image.
struct Shared {
  std::vector<std::size_t> points;
  bool is_named = false;
  std::string stem, caption;
};
// name of an image, file name of its PNG file, and file name of its EXR file; each file name is a
// hash of the file's content
using Key = std::array<std::string, 3>;

Key key_of(const SavedImage& image) { return {image.name, image.file, image.exr}; }

// Finds the axes on which all `points` have the same value, and at least one of `others` has a
// different value.
std::vector<Coordinate> find_distinction(const ExperimentFile& file,
                                         const std::vector<std::size_t>& points,
                                         const std::vector<std::size_t>& others) {
  std::vector<Coordinate> found;
  const auto& first = file.points[points[0]].at;
  for (std::size_t axis = 0; axis < first.size(); ++axis) {
    const auto has_it = [&](std::size_t i) {
      return base::to_toml(*file.points[i].at[axis].value) == base::to_toml(*first[axis].value);
    };
    if (std::ranges::all_of(points, has_it) && !std::ranges::all_of(others, has_it))
      found.push_back(first[axis]);
  }
  return found;
}

// Keeps letters, digits and dots. Replaces each sequence of other characters by one dash.
std::string make_stem(const std::string& text) {
  std::string stem;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.')
      stem += c;
    else if (!stem.ends_with('-'))
      stem += '-';
  return stem;
}

void name_image(const std::string& name, const std::vector<Coordinate>& distinction, Shared& image,
                std::set<std::string>& known) {
  std::string stem = "image-" + name;
  image.caption = name;
  for (const auto& at : distinction) {
    const auto cell = to_value(at);
    const auto value = to_string(cell);
    stem += "-" + (as_number(cell) ? at.axis + "-" + value : fs::path(value).stem().string());
    image.caption += fmt::format(", {} = {}", at.axis, value);
  }
  stem = make_stem(stem);
  auto unique = stem;
  for (int n = 2; !known.insert(unique).second; ++n) unique = fmt::format("{}-{}", stem, n);
  image.stem = unique;
}

// Groups equal images, and names each group by the axes that distinguish it from other images. A
// key image, which shows a stage of the program's progress, is compared only with images of the
// same name, because its name already describes its content.
std::map<Key, Shared> find_shared(const ExperimentFile& file, const Results& results) {
  std::vector<Key> order;
  std::map<Key, Shared> shared;
  // points that have an image of this name
  std::map<std::string, std::vector<std::size_t>> namesakes;
  for (std::size_t i = 0; i < results.size(); ++i)
    for (const auto& image : results[i].images) {
      auto& entry = shared[key_of(image)];
      if (entry.points.empty()) order.push_back(key_of(image));
      entry.points.push_back(i);
      entry.is_named = image.is_named;
      namesakes[image.name].push_back(i);
    }
  const auto all = all_points(file);
  std::set<std::string> known;
  for (const auto& key : order) {
    Shared& image = shared[key];
    const auto& others = image.is_named ? namesakes[key[0]] : all;
    name_image(key[0], find_distinction(file, image.points, others), image, known);
  }
  return shared;
}

// Throws if two points have different images although their programs' picture keys are equal. The
// picture key contains all that the image may depend on.
void check_images(const ExperimentFile& file, const Results& results) {
  std::map<std::string, std::string> known;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Experiment& e = file.points[i].experiment;
    if (!e.program->picture_key || !results[i].is_complete()) continue;
    for (const auto& image : results[i].images) {
      if (image.at_s) continue;
      const auto [entry, is_new] = known.emplace(e.program->picture_key(e.params), image.file);
      base::check_equal("image of one scene from another machine", image.file, entry->second);
    }
  }
}

}  // namespace

std::vector<SavedImage> save_images(const std::vector<programs::Image>& images,
                                    const fs::path& folder) {
  std::vector<SavedImage> saved;
  for (const auto& image : images) {
    auto& entry = saved.emplace_back(
        SavedImage{image.name, image.at_s, save_by_content(image.save, folder, image.extension), "",
                   image.is_named});
    if (image.save_exr) entry.exr = save_by_content(image.save_exr, folder, ".exr");
  }
  return saved;
}

void place_images(const ExperimentFile& file, Results& results, const fs::path& records,
                  const fs::path& folder) {
  check_images(file, results);
  const auto shared = find_shared(file, results);
  for (std::size_t i = 0; i < results.size(); ++i)
    for (auto& image : results[i].images) {
      const Shared& placed = shared.at(key_of(image));
      const auto place = [&](const std::string& source) {
        const auto name = placed.stem + fs::path(source).extension().string();
        if (!fs::exists(folder / name)) link_file(records / source, folder / name);
        return name;
      };
      image.path = place(image.file);
      if (!image.exr.empty()) image.exr = place(image.exr);
      image.caption = placed.caption;
      if (!image.at_s) continue;
      image.caption += fmt::format(", after {:.2f} s", *image.at_s);
      if (placed.points.size() > 1) image.caption += fmt::format(" at {}", name_of(file.points[i]));
    }
}

}  // namespace laboratory

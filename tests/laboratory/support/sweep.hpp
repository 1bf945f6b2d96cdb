// A test fixture with a small sweep in a folder of its own, and the files that its runs leave
// there.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {

using Arguments = std::vector<std::string>;

// Six points with two different images, key images and a check.
inline const char* const SWEEP =
    "[image]\nwidth = 12\nheight = 8\n[[stage]]\nmin_cell = 4\n[[stage]]\n"
    "[[check]]\nname = \"c\"\nof = \"rays\"\nwithin = 1e-9\nformula = \"rays\"\n"
    "[sweep]\nobjects = [20, 9]\nworkers = [1, 3, 2]\n";

struct Sweep : testing::Test {
  Sweep() { std::ofstream(folder.path / "e.toml") << SWEEP; }

  Outcome run(Arguments more) {
    more.insert(more.begin(), {"run", "e.toml"});
    return tlab(folder.path, more);
  }
  // The contents of the user-visible files of a results folder, by name.
  std::map<std::string, std::string> visible(const std::string& name) const {
    std::map<std::string, std::string> files;
    const auto root = folder.path / name;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      const auto path = std::filesystem::relative(entry.path(), root).string();
      if (entry.is_regular_file() && !path.starts_with("points") && path != "run.json")
        files[path] = read_file(entry.path());
    }
    return files;
  }
  std::vector<std::filesystem::path> records(const std::string& name) const {
    std::vector<std::filesystem::path> found;
    const auto points = folder.path / name / "points";
    if (!std::filesystem::exists(points)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(points))
      if (entry.path().extension() == ".json" && entry.path().stem() != "experiment")
        found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
  }
  TemporaryFolder folder;
};

}  // namespace laboratory

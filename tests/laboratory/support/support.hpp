// What the tests of experiments share: a folder that goes away.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/whole_file.hpp"

namespace laboratory {

inline std::string read_file(const std::filesystem::path& path) { return base::read_text(path); }

inline void write_file(const std::filesystem::path& path, std::string_view bytes) {
  base::save_whole(path, bytes);
}

struct TemporaryFolder {
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tlab-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name);
    path = std::filesystem::canonical(name);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // Everything directly inside, hidden or not, sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      found.push_back(entry.path().filename().string());
    std::ranges::sort(found);
    return found;
  }

  std::filesystem::path path;
};

// The message of the exception that `action` throws; "" where it throws none.
template <typename Exception, typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return {};
}

inline bool is_gnuplot_installed() {
  return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

}  // namespace laboratory

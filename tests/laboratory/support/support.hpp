// Functions that the tests of the laboratory share.
#pragma once

#include <gtest/gtest.h>

#include "base/whole_file.hpp"
#include "tests/support/files.hpp"

namespace laboratory {

using test::message_of;
using test::TemporaryFolder;

inline std::string read_file(const std::filesystem::path& path) { return base::read_text(path); }

inline void write_file(const std::filesystem::path& path, std::string_view bytes) {
  base::save_whole(path, bytes);
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline bool is_gnuplot_installed() {
  return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

}  // namespace laboratory

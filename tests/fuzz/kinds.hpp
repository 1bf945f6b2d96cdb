#pragma once
// The readers by kind of file, and functions that they share.
#include <fmt/format.h>

#include <filesystem>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

std::vector<Reader> scene_readers();
std::vector<Reader> network_readers();
std::vector<Reader> text_readers();
std::vector<Reader> result_readers();
std::vector<Reader> picture_readers();

/// Writes the records 0.json and 1.json, unless they exist. The texts for the reader "simulation"
/// refer to them.
void save_two_records(const std::filesystem::path& folder);

/// The path of a file in the project's sources.
std::string place_of(const std::string& path);

/// Throws Broken, with `what`, unless the two values are equal.
template <class A, class B>
void expect_same(std::string_view what, const A& found, const B& expected) {
  if (!(found == expected)) throw Broken(fmt::format("{} differs", what));
}

/// Throws Broken, with `what`, unless `holds` is true.
inline void expect(bool holds, std::string_view what) {
  if (!holds) throw Broken(fmt::format("{}: does not hold", what));
}

/// Reads a text that tlab itself has written. Throws Broken if it is refused.
template <class Read>
auto read_again(std::string_view what, const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    throw Broken(fmt::format("{} is refused when it is read again: {}", what, error.what()));
  }
}

}  // namespace fuzz

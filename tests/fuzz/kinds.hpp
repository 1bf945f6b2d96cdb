#pragma once
// Readers by kind, and the code that they share.
#include <fmt/format.h>

#include <filesystem>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

std::vector<Reader> scene_readers();
std::vector<Reader> network_readers();
std::vector<Reader> text_readers();
std::vector<Reader> result_readers();
std::vector<Reader> picture_readers();

/// Writes the records 0.json and 1.json unless they exist. Texts for the reader "simulation" name
/// them.
void save_two_records(const std::filesystem::path& folder);

/// The path of a file of the project.
std::string place_of(const std::string& path);

/// Throws Broken with `what` unless the two are equal.
template <class A, class B>
void expect_same(std::string_view what, const A& found, const B& expected) {
  if (!(found == expected)) throw Broken(fmt::format("{} differs", what));
}

/// Throws Broken with `what` unless `holds`.
inline void expect(bool holds, std::string_view what) {
  if (!holds) throw Broken(fmt::format("{}: does not hold", what));
}

/// The result of `read` on a text that tlab wrote, which it must accept.
template <class Read>
auto read_again(std::string_view what, const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    throw Broken(fmt::format("{} is refused when it is read again: {}", what, error.what()));
  }
}

}  // namespace fuzz

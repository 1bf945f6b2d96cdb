#pragma once
// The readers by kind, and what they share.
#include <fmt/format.h>

#include <filesystem>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

std::vector<Reader> scene_readers();
std::vector<Reader> network_readers();
std::vector<Reader> text_readers();
std::vector<Reader> result_readers();
std::vector<Reader> picture_readers();

/// Writes the records 0.json and 1.json, which the texts for the reader "simulation" name, unless
/// they are there.
void save_two_records(const std::filesystem::path& folder);

/// Where a file of the project is.
std::string place_of(const std::string& path);

/// Throws Broken unless they are equal, with `what` should be.
template <class A, class B>
void expect_same(std::string_view what, const A& found, const B& expected) {
  if (!(found == expected)) throw Broken(fmt::format("{} differs", what));
}

/// Throws Broken with what does not hold.
inline void expect(bool holds, std::string_view what) {
  if (!holds) throw Broken(fmt::format("{}: does not hold", what));
}

/// What `read` gives for a text that was written, which it must accept.
template <class Read>
auto read_again(std::string_view what, const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    throw Broken(fmt::format("{} is refused when it is read again: {}", what, error.what()));
  }
}

}  // namespace fuzz

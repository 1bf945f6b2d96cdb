#pragma once
// Copies of result files that several folders or processes share.
#include <exception>
#include <filesystem>

namespace laboratory {

/// Makes a folder and its parents. A signal that arrives meanwhile ends the program only afterwards
/// (base/early_end.hpp).
void make_folders(const std::filesystem::path& path);

/// Adds the visible files of folder `from` that folder `to` lacks, as hard links, or as copies on
/// file systems without links. Skips folders inside `from`. A missing `from` counts as empty.
/// Throws std::system_error or BadInput with the path.
void link_files(const std::filesystem::path& from, const std::filesystem::path& to);

/// Links or copies one file to the path `to`, and replaces an older file there.
void link_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Adds the records (folders in points/) of one results folder to another.
void link_records(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes into a results folder, with one retry after a failure. The first attempt fails if another
/// process replaces the folder at that moment.
template <class Write>
void try_twice(const Write& write) {
  try {
    write();
  } catch (const std::exception&) {
    write();
  }
}

}  // namespace laboratory

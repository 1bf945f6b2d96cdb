#pragma once
// Copies of result files that several folders or processes share.
#include <exception>
#include <filesystem>

namespace laboratory {

/// Makes a folder and its parents, but not while the program ends early (base/early_end.hpp).
void make_folders(const std::filesystem::path& path);

/// Adds the visible files of folder `from` that are missing in folder `to`: as hard links, or as
/// copies on file systems without links. Skips folders inside `from`; a missing `from` counts as
/// empty. Throws std::system_error or BadInput with the path.
void link_files(const std::filesystem::path& from, const std::filesystem::path& to);

/// Links or copies one file; `to` is its new name, and replaces an older file.
void link_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Adds the folders of records in points/ of one results folder to another.
void link_records(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes into a results folder, with a second attempt after a failure: another process may be
/// exchanging the whole folder, which takes a moment.
template <class Write>
void try_twice(const Write& write) {
  try {
    write();
  } catch (const std::exception&) {
    write();
  }
}

}  // namespace laboratory

#pragma once
// Files of results that several folders, or several processes, share.
#include <exception>
#include <filesystem>

namespace laboratory {

/// Makes a folder and its parents; not while the program ends early (base/early_end.hpp).
void make_folders(const std::filesystem::path& path);

/// Puts the visible files of folder `from` that folder `to` lacks into `to`: as links to the same
/// bytes, or as copies where the file system has no links. Folders inside `from` are skipped, and a
/// missing `from` has no files. Throws std::system_error or BadInput with the path.
void carry_files(const std::filesystem::path& from, const std::filesystem::path& to);

/// Does the same for one file; `to` is its new name, and an older file of that name is replaced.
void carry_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Carries the folders of records in points/ of one folder of results into another.
void carry_records(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes into a folder of results, and once more where that fails: another process may be
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

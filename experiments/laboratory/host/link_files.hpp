#pragma once
// Hard links or copies of result files, which several folders or processes share.
#include <exception>
#include <filesystem>

namespace laboratory {

/// Makes a folder and its parents. A signal that arrives during the call ends the program only
/// after the call (base/early_end.hpp).
void make_folders(const std::filesystem::path& path);

/// Adds to the folder `to` the visible files of the folder `from` that `to` lacks, as hard links,
/// or as copies on file systems without links. Skips subfolders of `from`. Treats a missing `from`
/// as empty. Throws std::system_error or BadInput with the path.
void link_files(const std::filesystem::path& from, const std::filesystem::path& to);

/// Links or copies one file to the path `to`, and replaces an older file there.
void link_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Adds the records of the results folder `from` to the results folder `to`. The records are in
/// subfolders of points/. Skips the records in points/lone, which are valid only in `from`.
void link_records(const std::filesystem::path& from, const std::filesystem::path& to);

/// Calls `write`, which writes into a results folder, and calls it again if it fails. The first
/// call fails if another process replaces the folder at that moment.
template <class Write>
void try_twice(const Write& write) {
  try {
    write();
  } catch (const std::exception&) {
    write();
  }
}

}  // namespace laboratory

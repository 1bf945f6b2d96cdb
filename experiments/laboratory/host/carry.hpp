#pragma once
// The same files in two folders.
#include <filesystem>

namespace laboratory {

// Puts the visible files of folder `from` that `to` lacks there too: as links to the same bytes, or
// as copies where the file system has no links. Folders inside are passed over; a `from` that is
// not there has no files. Throws std::system_error with the path.
void carry_files(const std::filesystem::path& from, const std::filesystem::path& to);

// The same of one file: `to` is its new name, which it takes from an older file.
void carry_file(const std::filesystem::path& from, const std::filesystem::path& to);

// The folders of records in points/ of one folder of results, carried into another.
void carry_records(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace laboratory

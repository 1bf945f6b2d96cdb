#pragma once
// Atomic writing of files: a file is complete or absent.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace base {

/// Writes `bytes` beside `path` (".NAME.partial-HOST-PID-N"), then renames. If a step fails (a full
/// disk, a missing folder) or the program ends early (early_end.hpp), nothing is left behind and an
/// older file is unchanged. Follows symbolic links; writes in place if `path` is not a regular file
/// (/dev/stdout, a pipe). Throws std::system_error "path: cannot be written: ...".
void save_whole(const std::filesystem::path& path, std::string_view bytes);

/// Does the same with the output of `write`; exceptions of `write` pass through.
void save_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Writes a new file as save_whole does. Returns false and writes nothing if the file exists, even
/// if another process makes it at the same time.
bool save_new(const std::filesystem::path& path, std::string_view bytes);

/// Throws as save_whole would, before there is anything to write: if `path` is a folder, or if no
/// file can be made beside it.
void check_can_save(const std::filesystem::path& path);

/// The bytes of a file, at most `most`. Throws BadInput "path: cannot be read: ..." for a missing
/// file, a folder or a read error, and BadInput with the limit for a longer file.
std::string read_text(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

}  // namespace base

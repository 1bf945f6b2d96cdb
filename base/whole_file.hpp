#pragma once
// Files that are whole or absent.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace base {

/// Writes `bytes` beside `path` (".NAME.partial-HOST-PID-N"), then renames. When a step fails (a
/// full disk, a missing folder), or the program ends early (early_end.hpp), nothing is left behind
/// and an older file keeps its bytes. A link is
/// followed; what exists and is not a regular file (/dev/stdout, a pipe) is written in place.
/// Throws std::system_error "path: cannot be written: ...".
void save_whole(const std::filesystem::path& path, std::string_view bytes);

/// Does the same with what `write` puts into the stream; what `write` throws passes through.
void save_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Writes a file that is not there, as save_whole does; false, and nothing is written, where there
/// is one, even if another process makes it at the same time.
bool save_new(const std::filesystem::path& path, std::string_view bytes);

/// Throws as save_whole would where that is known before there is anything to write: for a folder,
/// and where no file can be made beside `path`.
void check_can_save(const std::filesystem::path& path);

/// The bytes of a file, at most `most`. Throws BadInput "path: cannot be read: ..." for a file that
/// is not there, is a folder or cannot be read, and BadInput with the limit for a longer one.
std::string read_text(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

}  // namespace base

#pragma once
// Atomic writing of files: a file is complete or absent. A file that the program has read is not
// overwritten.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

struct stat;

namespace base {

/// Writes `bytes` beside `path` (".NAME.partial-HOST-PID-N"), then renames the file. After a
/// failure (full disk, missing folder) or an early end (early_end.hpp), no new file is left, and an
/// older file is unchanged. Follows symbolic links. Writes in place if `path` is not a regular file
/// (/dev/stdout, a pipe). Throws std::system_error "path: cannot be written: ...", and BadInput for
/// a file that the program has read.
void save_whole(const std::filesystem::path& path, std::string_view bytes);

/// Saves the output of `write` as the other overload saves bytes. Exceptions of `write` pass
/// through.
void save_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Writes a new file as save_whole does. Returns false and writes nothing if the file exists, even
/// if another process has just made it.
bool save_new(const std::filesystem::path& path, std::string_view bytes);

/// Checks in advance that save_whole can work. Throws the same error if `path` is a folder or if no
/// file can be made beside it.
void check_can_save(const std::filesystem::path& path);

/// The bytes of a file of at most `most` bytes and 1 GiB, or of a pipe of at most 256 MiB. Throws
/// BadInput "path: cannot be read: ..." for a missing file, a folder, a device, a read error, and a
/// pipe without a writer or without bytes. Throws BadInput with the limit for a longer file.
/// Remembers the file, so that it is not overwritten.
std::string read_text(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

/// Reads a file as read_text does, for a caller that may replace it, such as a saved state. The
/// limit is the size of the host's memory.
std::string read_own_text(const std::filesystem::path& path);

/// Opens a file as read_text does, with the same errors, and remembers it. Refuses pipes too. For
/// files that a library reads.
void check_can_read(const std::filesystem::path& path);

/// While an object lives, read files are remembered, and save_whole() refuses to replace them.
/// There is at most one object. These functions are thread-safe.
class InputGuard {
 public:
  InputGuard();
  ~InputGuard();
  InputGuard(const InputGuard&) = delete;
  InputGuard& operator=(const InputGuard&) = delete;
};

/// Remembers an open file. Files are compared by device and inode, so that links count too. A later
/// file with the same inode has another time of modification.
void note_input(const struct stat& file);

/// Throws BadInput if `path` is a remembered file, under this name or another one.
void check_no_input(const std::filesystem::path& path);

}  // namespace base

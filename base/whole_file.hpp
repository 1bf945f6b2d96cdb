#pragma once
// Atomic writing of files: after an error or a crash, a file is either complete or absent. Also
// prevents the program from overwriting a file that it has read.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

struct stat;

namespace base {

/// Writes `bytes` to a hidden file beside `path` (".NAME.partial-HOST-PID-N"), then renames it to
/// `path`. After a failure, such as a full disk or a missing folder, or after an early end of the
/// program (early_end.hpp), no new file remains, and an older file is unchanged. Follows symbolic
/// links. Writes directly to `path` if it is not a regular file (/dev/stdout, a pipe). Throws
/// std::system_error "path: cannot be written: ...", and BadInput if the program has read this
/// file, or for a pipe that nobody opens for reading within one second.
void save_whole(const std::filesystem::path& path, std::string_view bytes);

/// Like save_whole above, but calls `write` to write the bytes to a stream. Passes on the
/// exceptions of `write`.
void save_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Writes a new file as save_whole does. Returns false and writes nothing if the file exists, even
/// if another process created it only just before.
bool save_new(const std::filesystem::path& path, std::string_view bytes);

/// Checks in advance that save_whole can write to `path`. Throws the error of save_whole if `path`
/// is a folder or if no file can be created beside it.
void check_can_save(const std::filesystem::path& path);

/// Returns the bytes of a file or pipe. A file may have at most `most` bytes, and at most 1 GiB; a
/// pipe at most 256 MiB. Throws BadInput with the limit for a longer file or pipe. Throws BadInput
/// "path: cannot be read: ..." for a missing file, a folder, a device, a read error, an empty pipe,
/// and a pipe without a writer. Remembers the file, so that save_whole refuses to overwrite it.
std::string read_text(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

/// Reads a file as read_text does, but lets the caller overwrite it, for example a saved state. The
/// limit on its size is the host's memory, or `most` if that is less.
std::string read_own_text(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

/// Checks that read_text could open the file, and remembers the file. Throws the same errors as
/// read_text if a file is missing, unreadable, a folder or a device. Also refuses pipes. To be
/// called for files that a library opens by itself.
void check_can_read(const std::filesystem::path& path);

/// While an object of this class exists, the functions of this header remember the files that they
/// read, and save_whole() refuses to overwrite these. At most one object may exist. These functions
/// are thread-safe.
class InputGuard {
 public:
  InputGuard();
  ~InputGuard();
  InputGuard(const InputGuard&) = delete;
  InputGuard& operator=(const InputGuard&) = delete;
};

/// Remembers an open file as read. Files are identified by device, inode and time of modification.
/// All links to a file therefore count as the same file, but a later file that reuses the inode
/// does not.
void note_input(const struct stat& file);

/// Throws BadInput if `path` is a name of a remembered file.
void check_no_input(const std::filesystem::path& path);

}  // namespace base

#pragma once
// The files that the program has read. It must not overwrite them.
#include <filesystem>

struct stat;

namespace base {

/// While an object lives, read files are remembered, and save_whole() refuses to replace them
/// (base/whole_file.hpp). There is at most one object. Functions of this header are thread-safe.
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

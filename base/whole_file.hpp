#pragma once
// Files that are whole or absent.

#include <cstdio>
#include <functional>
#include <string>

namespace base {

/// `write` puts the bytes into the file that it is given, and returns 0 or an errno; they go to a
/// file beside `path`, which takes its place when whole. What exists and is no regular file (a
/// device, a pipe) is written in place. std::system_error naming `path` if it cannot be written,
/// and then nothing is left behind.
void save_whole(const std::string& path, const std::function<int(std::FILE*)>& write);

/// The bytes of a file, at most `most`. Throws BadInput, beginning with the path, for a file that
/// is not there, is a folder, cannot be read, or is longer.
std::string read_text(const std::string& path, std::size_t most);

}  // namespace base

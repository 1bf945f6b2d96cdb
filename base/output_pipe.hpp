#pragma once
// Writing to named pipes without waiting for ever for a reader.
#include <filesystem>
#include <string_view>

namespace base {

/// Opens the pipe for writing and keeps it open until write_to_pipe() has written to it, since a
/// reader stops when the last writer closes the pipe. Waits at most one second for a reader. Throws
/// BadInput "path: cannot be written: found a pipe that nobody reads" if none appears, and
/// std::system_error for other errors.
void open_output_pipe(const std::filesystem::path& path);

/// Writes the bytes to the pipe and closes it; opens it first unless it is open. Throws the errors
/// of open_output_pipe(), and std::system_error if the reader goes away.
void write_to_pipe(const std::filesystem::path& path, std::string_view bytes);

}  // namespace base

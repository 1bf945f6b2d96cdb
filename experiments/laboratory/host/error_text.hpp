#pragma once
// Messages of exceptions in tlab's words, and the end of the program for lack of memory.
#include <exception>
#include <string>

namespace laboratory {

inline constexpr const char* NO_MEMORY = "the host is out of memory";

/// The message of an exception, without the wording of the standard library: for lack of memory,
/// processes and threads, and for errors of file systems. Hidden names of files that are being
/// written become the final names. Other exceptions keep their text.
std::string describe_error(const std::exception& error);

/// Keeps memory in reserve for the end of the program. If memory is exhausted where no exception
/// can be caught, the program undoes partial work (base/early_end.hpp), prints NO_MEMORY and exits
/// with code 2. The main process calls it once.
void secure_memory();

}  // namespace laboratory

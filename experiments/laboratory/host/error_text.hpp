#pragma once
// Wording of error messages, and the end of the program for lack of memory.
#include <exception>
#include <string>

namespace laboratory {

inline constexpr const char* NO_MEMORY = "the host is out of memory";

/// The message of an exception. Replaces the standard library's wording for lack of memory,
/// processes or threads, and for errors of file systems. A file that is being written has a hidden
/// temporary name; the message shows its final name instead. Other exceptions keep their text.
std::string describe_error(const std::exception& error);

/// Keeps memory in reserve for an orderly end of the program. If memory is exhausted where no
/// exception can be caught, the program undoes partial work (base/early_end.hpp), prints NO_MEMORY
/// and exits with code 2. The main process calls this function once.
void secure_memory();

}  // namespace laboratory

#pragma once
// Wording of error messages, the end of the program for lack of memory, and the size of the stack.
#include <exception>
#include <string>

namespace laboratory {

inline constexpr const char* NO_MEMORY = "the host is out of memory";

/// The message of an exception. Replaces the standard library's wording for lack of memory,
/// processes or threads, and for errors of file systems. A file that is being written has a hidden
/// temporary name; the message shows its final name instead. Other exceptions keep their text.
std::string describe_error(const std::exception& error);

/// Raises the limit on the stack of the main thread and of new threads to 8 MiB, or as far as the
/// system allows. Throws BadInput if less than 1 MiB is allowed. To be called before other threads
/// start.
void secure_stack();

/// Keeps memory in reserve for an orderly end of the program. If memory is exhausted where no
/// exception can be caught, the program undoes partial work (base/early_end.hpp), prints NO_MEMORY
/// and exits with code 2. The main process calls this function once.
void secure_memory();

}  // namespace laboratory

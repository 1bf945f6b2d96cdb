#pragma once
// Standard input, output and error, whether terminal, file, pipe or closed.
#include <cstddef>
#include <string_view>

namespace laboratory {

/// Makes writing to a full, closed or unread stream an error instead of ending the program.
/// Reserves the descriptors of closed streams, so that files opened later do not take them.
void secure_streams();

/// Waits while standard error is a full pipe.
void wait_for_error_stream();

/// Prints the text on standard error, and ignores failures.
void print_on_error(std::string_view text);

/// Prints a line on standard error with control characters made visible (base/message.hpp). On a
/// terminal it overwrites the progress bar.
void print_line(std::string_view text);

/// Prints a line with the prefix "tlab: ", as print_line does.
void complain(std::string_view text);

/// Width of the terminal on standard output, in characters; 120 without a terminal.
std::size_t output_width();

/// Throws std::system_error if buffered output cannot be written.
void flush_output();

}  // namespace laboratory

#pragma once
// Standard input, output and error, for any kind of connection.
#include <cstddef>
#include <string_view>

namespace laboratory {

/// Turns writing to a full, closed or unread stream into an error instead of the program's end.
/// Keeps the descriptors of closed streams reserved, away from files that the program opens.
void secure_streams();

/// Waits while standard error is a full pipe.
void wait_for_error_stream();

/// Prints the text on standard error, and ignores failures.
void print_on_error(std::string_view text);

/// Prints a readable line on standard error (base/message.hpp); on a terminal it replaces the
/// progress bar.
void print_line(std::string_view text);

/// Prints a line with the prefix "tlab: ", as print_line does.
void complain(std::string_view text);

/// Width of standard output in characters: its terminal's, or else 120.
std::size_t output_width();

/// Throws std::system_error if printed text cannot be written.
void flush_output();

}  // namespace laboratory

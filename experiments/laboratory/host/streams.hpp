#pragma once
// Standard input, output and error, whatever they are connected to.
#include <cstddef>
#include <string_view>

namespace laboratory {

/// Makes writing to what is full, closed or read no more an error instead of the program's end, and
/// keeps the numbers of streams that are closed from files that the program opens.
void secure_streams();

/// Waits while standard error is a pipe that is full.
void wait_for_error_stream();

/// Prints the text on standard error; where that cannot be written there is nobody to tell.
void print_on_error(std::string_view text);

/// Prints a line on standard error so that people can read it (base/message.hpp); on a terminal in
/// the place of a progress bar.
void print_line(std::string_view text);

/// Prints a line that begins with "tlab: ", as print_line does.
void complain(std::string_view text);

/// How many characters a line of standard output takes: of its terminal, or else 120.
std::size_t output_width();

/// Throws std::system_error where something that was printed cannot be written.
void flush_output();

}  // namespace laboratory

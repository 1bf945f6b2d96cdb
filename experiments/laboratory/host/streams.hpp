#pragma once
// Standard input, output and error, which may be a terminal, a file, a pipe or closed.
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "base/message.hpp"
#include "experiments/laboratory/host/colour.hpp"

namespace laboratory {

/// Makes the program report an error when it writes to a full or closed stream, or to a pipe
/// without a reader, instead of dying from a signal. Reserves the descriptors of closed streams, so
/// that files opened later do not get them.
void secure_streams();

/// Prepares a value for print_out(): makes control characters of texts visible; returns other
/// values unchanged.
template <class T>
auto make_printable(const T& value) {
  if constexpr (std::is_same_v<T, Painted>)
    return value.text;
  else if constexpr (std::is_convertible_v<const T&, std::string_view>)
    return base::show_controls(value);
  else
    return value;
}

/// Prints a text on standard output. Throws std::system_error "cannot write standard output: ...".
void write_output(std::string_view text);

/// Formats values and prints them on standard output. Control characters in the values, except line
/// ends and tabs, become visible, so that text from a file cannot control the terminal.
template <class... Args>
void print_out(fmt::string_view format, const Args&... args) {
  const auto shown = std::make_tuple(make_printable(args)...);
  std::apply(
      [&](const auto&... all) {
        write_output(fmt::vformat(format, fmt::make_format_args(all...)));
      },
      shown);
}

/// If standard error is a full pipe, waits until the pipe accepts output.
void wait_for_error_stream();

/// Prints the text on standard error, and ignores failures.
void print_on_error(std::string_view text);

/// Prints a line on standard error, with control characters made visible (base/message.hpp). On a
/// terminal that obeys escape sequences, the line overwrites the progress bar.
void print_line(std::string_view text);

/// Prints a line with the prefix "tlab: ", as print_line does.
void complain(std::string_view text);

/// Width of the terminal on standard output, in characters; 120 without a terminal.
std::size_t output_width();

/// Throws std::system_error if buffered output cannot be written.
void flush_output();

/// Prints a text. On a terminal, shows it with the pager named by the environment variable PAGER.
/// Without PAGER the pager is "less", set to print short texts directly. Prints without a pager if
/// it cannot be started.
void print_paged(const std::string& text);

}  // namespace laboratory

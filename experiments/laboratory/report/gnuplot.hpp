// The program gnuplot, as a child process.
#pragma once

#include <string>
#include <string_view>

namespace laboratory {

/// A text as a literal of gnuplot's language in which nothing is expanded: no variable, no escape,
/// no command. Control characters become blanks.
std::string quote_for_gnuplot(std::string_view text);

/// The files that `script` draws: once as SVG, once as PNG.
struct Drawing {
  std::string svg, png;
};

/// Runs gnuplot without the user's settings. `script` sets neither terminal nor output; `name` is
/// for the drawing's identifiers and for messages. The SVG is 800 wide and `height` high, the
/// PNG twice that in pixels. std::runtime_error when gnuplot is not installed
/// (with the remedy), fails (with its message), or leaves an incomplete file.
Drawing run_gnuplot(const std::string& script, const std::string& name, int height = 500);

}  // namespace laboratory

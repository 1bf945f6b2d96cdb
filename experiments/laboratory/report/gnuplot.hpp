// Plots as files: the program gnuplot draws them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// The bytes of the two files that a script draws.
struct Drawing {
  std::string svg, png;
};

/// Runs gnuplot without the user's settings. `script` sets neither terminal nor output; `name` is
/// for the drawing's identifiers and for messages. The SVG is 800 pixels wide and `height` high,
/// the PNG twice that. Throws std::runtime_error when gnuplot is not installed (with the remedy),
/// fails (with its message), or leaves an incomplete file.
Drawing run_gnuplot(const std::string& script, const std::string& name, int height = 500);

/// Writes NAME.svg and NAME.png into an existing folder; the bytes depend only on the plot and on
/// gnuplot's version and fonts. Throws std::invalid_argument, naming the plot, where it has no
/// points or a name that is no file stem; what run_gnuplot throws; std::system_error when a file
/// cannot be written.
void draw_plot(const Plot& plot, const std::filesystem::path& folder);

/// Draws all plots, as many at once as this host has processors. Returns for each why it could not
/// be drawn or written, "" where it was.
std::vector<std::string> draw_plots(const std::vector<Plot>& plots,
                                    const std::filesystem::path& folder);

}  // namespace laboratory

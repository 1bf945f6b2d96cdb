// Drawing of plots with the program gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// The contents of the two files that a script draws.
struct Drawing {
  std::string svg, png;
};

/// Runs gnuplot without the user's settings. `script` must set neither terminal nor output. `name`
/// appears in the drawing's identifiers and in messages. The SVG is 800 pixels wide and `height`
/// high; the PNG has twice that size. Throws std::runtime_error if gnuplot is not installed (with
/// the remedy), fails (with its message), or leaves an incomplete file.
Drawing run_gnuplot(const std::string& script, const std::string& name, int height = 500);

/// Writes NAME.svg and NAME.png into an existing folder. The bytes depend only on the plot, and on
/// gnuplot's version and fonts. Throws std::invalid_argument with the plot's name if the plot has
/// no points, or its name is not valid for a file. Throws as run_gnuplot does, and
/// std::system_error if a file cannot be written.
void draw_plot(const Plot& plot, const std::filesystem::path& folder);

/// Draws all plots, as many in parallel as the host has processors. Returns one text for each plot:
/// "" for success, else the error.
std::vector<std::string> draw_plots(const std::vector<Plot>& plots,
                                    const std::filesystem::path& folder);

}  // namespace laboratory

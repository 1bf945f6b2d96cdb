// Draws plots with the program gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// The contents of the two files made from a script.
struct Drawing {
  std::string svg, png;
};

/// Runs gnuplot without the user's settings. The script must not set the terminal or the output.
/// `name` appears in the identifiers of the drawing and in messages. The SVG drawing is 800 pixels
/// wide and `height` pixels high; the PNG drawing is twice as large. Throws std::runtime_error if
/// gnuplot is not installed (the message says what to do), fails (with gnuplot's message), or
/// leaves an incomplete file.
Drawing run_gnuplot(const std::string& script, const std::string& name, int height = 500);

/// Draws a script as an SVG with the exact width of the style and with the height in points. One
/// user unit of the SVG is one point. The background is transparent. Throws as run_gnuplot does.
std::string draw_figure(const std::string& script, const std::string& name,
                        const base::FigureStyle& style, int height);
/// Draws a plot in the style of its Plot::figure.
std::string draw_figure(const Plot& plot);

/// Writes NAME.svg and NAME.png into an existing folder. A plot with a figure also gets NAME.svg
/// and NAME.pdf in the folder "figures" beside it. The bytes depend only on the plot, and on
/// gnuplot's version and fonts. Throws std::invalid_argument with the plot's name if the plot has
/// no points, or its name is not valid for a file. Throws as run_gnuplot does, and
/// std::system_error if a file cannot be written.
void draw_plot(const Plot& plot, const std::filesystem::path& folder);

/// Draws all plots, as many at the same time as the host has processors. Returns for each plot ""
/// if it succeeded, else the error.
std::vector<std::string> draw_plots(const std::vector<Plot>& plots,
                                    const std::filesystem::path& folder);

}  // namespace laboratory

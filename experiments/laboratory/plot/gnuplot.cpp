#include "experiments/laboratory/plot/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "base/host_program.hpp"
#include "base/share.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// Runs a script, and returns the drawing that gnuplot writes to standard output. All runs of
// gnuplot use this function. Throws std::runtime_error with the plot's name if gnuplot fails.
std::string run_script(const std::string& script, const std::string& name) {
  return base::run_program({.name = "gnuplot",
                            .arguments = {"-d", "-"},
                            .input = script,
                            .purpose = "plot " + name,
                            .remedy = "install gnuplot-nox"});
}

std::string make_id(const std::string& name) {
  std::string id = "plot_" + name;
  std::ranges::replace_if(
      id, [](unsigned char c) { return c >= 0x80 || !std::isalnum(c); }, '_');
  return id;
}

std::string on_svg(const std::string& script, const std::string& name, int height) {
  return fmt::format(
      "set terminal svg noenhanced size 800,{} dynamic font 'sans-serif,15' linewidth 1 "
      "name '{}' background '#ffffff'\n{}",
      height, make_id(name), script);
}

std::string on_png(const std::string& script, int height) {
  return fmt::format(
      "set terminal pngcairo noenhanced size 1600,{} font 'sans,13' fontscale 2 linewidth 2 "
      "pointscale 2 background '#ffffff'\n{}",
      2 * height, script);
}

bool is_whole_svg(const std::string& svg) { return svg.find("</svg>") != std::string::npos; }

[[noreturn]] void refuse_incomplete(const std::string& name) {
  throw std::runtime_error(
      fmt::format("plot {}: gnuplot left an incomplete drawing (is the memory full?)", name));
}

bool is_whole(const Drawing& drawing) {
  const std::string_view png = drawing.png;
  return is_whole_svg(drawing.svg) && png.size() > 12 && png.substr(png.size() - 8, 4) == "IEND";
}

// Escapes "]]>" in texts, which gnuplot writes unchanged. XML allows it only at the end of a CDATA
// section.
std::string escape_ends_of_cdata(std::string svg) {
  constexpr std::string_view BEGIN = "<![CDATA[", END = "]]>";
  for (std::size_t at = 0; (at = svg.find_first_of("<]", at)) != svg.npos; ++at) {
    const auto rest = std::string_view(svg).substr(at);
    if (rest.starts_with(BEGIN))
      at = std::min(svg.find(END, at), svg.size() - 1);
    else if (rest.starts_with(END))
      svg.replace(at, END.size(), "]]&gt;");
  }
  return svg;
}

}  // namespace

Drawing run_gnuplot(const std::string& script, const std::string& name, int height) {
  Drawing drawing{escape_ends_of_cdata(run_script(on_svg(script, name, height), name)),
                  run_script(on_png(script, height), name)};
  if (!is_whole(drawing)) refuse_incomplete(name);
  return drawing;
}

std::string draw_figure(const std::string& script, const std::string& name,
                        const base::FigureStyle& style, int height) {
  auto svg = escape_ends_of_cdata(run_script(
      fmt::format(
          "set terminal svg noenhanced size {:.0f},{} fixed font {} linewidth 1 name '{}'\n",
          std::ceil(style.width_pt()), height,
          quote_for_gnuplot(fmt::format("{},{:g}", style.font, style.font_pt)), make_id(name)) +
          script,
      name));
  if (!is_whole_svg(svg)) refuse_incomplete(name);
  // replaces the size of the drawing by the exact one: gnuplot knows only whole numbers of pixels
  const auto start = svg.find("<svg"), end = svg.find('>', start);
  svg.replace(start, end - start,
              fmt::format("<svg width=\"{:.6g}mm\" height=\"{}pt\" viewBox=\"0 0 {:.4f} {}\" "
                          "xmlns=\"http://www.w3.org/2000/svg\" "
                          "xmlns:xlink=\"http://www.w3.org/1999/xlink\"",
                          style.width_mm, height, style.width_pt(), height));
  return svg;
}

std::string draw_figure(const Plot& plot) {
  const auto size = choose_size(plot.figure);
  return draw_figure(make_gnuplot_script(plot, size), plot.name, plot.figure,
                     choose_height(plot, size));
}

void draw_plot(const Plot& plot, const fs::path& folder) {
  if (plot.name.empty() || plot.name.starts_with('.') || plot.name.find('/') != std::string::npos)
    throw std::invalid_argument(
        fmt::format("plot \"{}\": its name is no file stem (expected one without / and not "
                    "starting with a point)",
                    plot.name));
  const auto drawing = run_gnuplot(make_gnuplot_script(plot), plot.name, choose_height(plot));
  base::save_whole(folder / (plot.name + ".svg"), drawing.svg);
  base::save_whole(folder / (plot.name + ".png"), drawing.png);
  if (plot.figure.is_figure())
    save_figure(folder.parent_path() / "figures", plot.name, draw_figure(plot));
}

// Uses threads, not processes, since each thread only waits for its own gnuplot process.
std::vector<std::string> draw_plots(const std::vector<Plot>& plots, const fs::path& folder) {
  std::vector<std::string> failures(plots.size());
  const auto threads = std::max(1u, std::thread::hardware_concurrency());
  const auto draw = [&](int i) {
    const auto n = static_cast<std::size_t>(i);
    try {
      draw_plot(plots[n], folder);
    } catch (const std::exception& error) {
      failures[n] = describe_error(error);
    }
  };
  base::share(static_cast<int>(plots.size()), static_cast<int>(threads), draw);
  return failures;
}

}  // namespace laboratory

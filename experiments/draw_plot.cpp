#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "experiments/files.hpp"
#include "experiments/gnuplot.hpp"
#include "experiments/plot.hpp"

namespace experiments {
namespace {

// Three lines of key fit below the curves; more make the drawing higher, not the curves lower.
int choose_height(const Plot& plot) {
  std::size_t entries = plot.ideal_line ? 1 : 0, longest = 0;
  for (const auto& series : plot.series) {
    entries += !series.name.empty();
    longest = std::max(longest, series.name.size());
  }
  const std::size_t columns = std::max<std::size_t>(1, 700 / (70 + 9 * longest));
  const std::size_t lines = (entries + columns - 1) / columns;
  return 500 + 21 * (static_cast<int>(std::max<std::size_t>(lines, 3)) - 3);
}

}  // namespace

void draw_plot(const Plot& plot, const std::filesystem::path& folder) {
  if (plot.name.empty() || plot.name.starts_with('.') || plot.name.find('/') != std::string::npos)
    throw std::invalid_argument(
        fmt::format("plot \"{}\": its name is no file stem (expected one without / and not "
                    "starting with a point)",
                    plot.name));
  const auto drawing = run_gnuplot(make_gnuplot_script(plot), plot.name, choose_height(plot));
  write_file(folder / (plot.name + ".svg"), drawing.svg);
  write_file(folder / (plot.name + ".png"), drawing.png);
}

}  // namespace experiments

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>

#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/report/gnuplot.hpp"
#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

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

// A thread does no more than wait for its gnuplot.
void draw_plots(const std::vector<Plot>& plots, const std::filesystem::path& folder) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> failures(plots.size());
  auto draw = [&] {
    for (std::size_t i = next++; i < plots.size(); i = next++) try {
        draw_plot(plots[i], folder);
      } catch (...) {
        failures[i] = std::current_exception();
      }
  };
  const auto most = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < std::min(most, plots.size()); ++i) threads.emplace_back(draw);
  threads.clear();
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace laboratory

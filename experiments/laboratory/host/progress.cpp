#include "experiments/laboratory/host/progress.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
#include "experiments/laboratory/host/colour.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {

using std::chrono::steady_clock;

void announce_cost(const std::string& option, std::size_t count, double seconds_each,
                   bool is_confirmed) {
  constexpr double SHORT_S = 20, LONG_S = 180;
  const double all_s = seconds_each * static_cast<double>(count);
  if (all_s < SHORT_S) return;
  const auto cost = fmt::format("{} frames take about {:.0f} {}", count,
                                all_s < LONG_S ? all_s : all_s / 60, all_s < LONG_S ? "s" : "min");
  base::require(all_s < LONG_S || is_confirmed, option, "{}, expected fewer or --yes", cost);
  print_line(fmt::format("tlab: {}: {}", option, cost));
}

Progress::Progress(std::string what, std::size_t there)
    : what_(std::move(what)),
      there_(there),
      terminal_(obeys_escapes(stderr)),
      start_(steady_clock::now()) {}

Progress::~Progress() {
  if (terminal_) print_on_error("\r\x1b[K");
}

void Progress::say(const std::string& line) {
  print_line(line);
  shown_ = {};
}

void Progress::show(std::size_t done, std::size_t total) {
  const auto now = steady_clock::now();
  if (!terminal_ || (done < total && now - shown_ < std::chrono::milliseconds(100))) return;
  shown_ = now;
  constexpr std::size_t WIDTH = 30;
  const std::size_t filled = total == 0 ? WIDTH : WIDTH * done / total;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::string left;
  if (done > there_ && done < total)
    left = fmt::format(", about {:.0f} s left", elapsed * static_cast<double>(total - done) /
                                                    static_cast<double>(done - there_));
  print_on_error(fmt::format("\r\x1b[K{} [{:=<{}}{:<{}}] {}/{}{}", what_, "", filled, "",
                             WIDTH - filled, done, total, left));
}

}  // namespace laboratory

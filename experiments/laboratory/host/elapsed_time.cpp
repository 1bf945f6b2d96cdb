#include "experiments/laboratory/host/elapsed_time.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>

#include "base/early_end.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/host/interrupt.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {

namespace {

using std::chrono::steady_clock;

void show_seconds(const std::stop_token& stop, const std::string& what,
                  std::chrono::milliseconds after) {
  const auto start = steady_clock::now();
  std::mutex mutex;
  std::condition_variable_any wait;
  std::unique_lock lock(mutex);
  bool is_shown = false;
  const auto goes_on = [&](std::chrono::milliseconds time) {
    wait.wait_for(lock, stop, time, [] { return false; });
    return !stop.stop_requested();
  };
  while (goes_on(is_shown ? std::chrono::seconds(1) : after)) {
    is_shown = true;
    print_on_error(fmt::format("\r\x1b[K{}, {:.0f} s", what,
                               std::chrono::duration<double>(steady_clock::now() - start).count()));
  }
  if (is_shown) print_on_error("\r\x1b[K");
}

}  // namespace

ElapsedTime::ElapsedTime(std::string what, std::chrono::milliseconds after) {
  if (isatty(STDERR_FILENO) != 1) return;
  // blocks these signals in the new thread, so that the main thread receives them
  const base::HeldSignals held(ASKS_TO_END);
  thread_ = std::jthread([what = base::make_readable(what), after](const std::stop_token& stop) {
    show_seconds(stop, what, after);
  });
}

}  // namespace laboratory

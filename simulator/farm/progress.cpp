#include "simulator/farm/progress.hpp"

#include <algorithm>

namespace farm {

using machine::this_process;

void Progress::begin() {
  begun = interactive_since = last_task = this_process().now();
  before = observe::collect(observed);
  phase = Phase::interactive;
}

void Progress::note_task(std::size_t in_farm) {
  ++tasks;
  last_task = this_process().now();
  peak_tasks_in_farm = std::max(peak_tasks_in_farm, in_farm);
}

bool Progress::note_order(const std::string& why_without_effect) {
  ++orders;
  orders_shown.emplace_back(this_process().now(), std::nullopt);
  std::string why = why_without_effect;
  if (phase == Phase::ended)
    why = fmt::format("the program had ended at {:.4g} s", (ended - begun).value);
  if (why.empty()) return true;
  notes.push_back(fmt::format("order {} had no effect: {}", orders, why));
  return false;
}

void Progress::note_abort() {
  is_aborted = true;
  notes.push_back(
      fmt::format("order {} ended the run at {:.4g} s: the picture contains the results of all "
                  "rays sent before then",
                  orders, since_begun_s()));
}

void Progress::note_changed(std::uint8_t order) {
  auto& shown = orders_shown.at(order - 1u).second;
  if (!shown) shown = this_process().now();
}

void Progress::end_interactive() {
  interactive_s += (this_process().now() - interactive_since).value;
  phase = Phase::non_interactive;
}

void Progress::begin_interactive() {
  interactive_since = this_process().now();
  phase = Phase::interactive;
}

void Progress::end() {
  ended = this_process().now();
  if (phase == Phase::interactive) interactive_s += (ended - interactive_since).value;
  phase = Phase::ended;
  after = observe::collect(observed);
}

void Progress::cut() {
  if (phase == Phase::ended) return;
  after = observe::collect(observed);
  const machine::Seconds now = observed.now();
  if (phase == Phase::setup) {
    before = after;
    begun = last_task = now;
  }
  if (phase == Phase::interactive) interactive_s += (now - interactive_since).value;
  ended = now;
}

}  // namespace farm

#pragma once
// What the farm's coordination has done so far, as the user counts it.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/trace/render.hpp"
#include "simulator/observe/use.hpp"

namespace farm {

/// What a coordination has done so far. It is always up to date, so that a run can be cut short.
struct Progress {
  enum class Phase { setup, interactive, non_interactive, ended };

  explicit Progress(const machine::Machine& machine) : observed(machine) {}

  const machine::Machine& observed;
  Phase phase = Phase::setup;
  bool is_null = false;  ///< no ray is left within the limits, and the user may have more to say
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_since, ended;
  double interactive_s = 0;    ///< in the interactive phase, until `interactive_since`
  machine::Seconds last_task;  ///< handed out
  std::uint64_t tasks = 0;     ///< handed out
  std::size_t peak_tasks_in_farm = 0;
  std::size_t orders = 0;  ///< of the user, that have come
  /// When each order came, and the first pixel was changed by a ray that it had admitted.
  std::vector<std::pair<machine::Seconds, std::optional<machine::Seconds>>> orders_shown;
  bool is_aborted = false;         ///< by the user
  std::vector<std::string> notes;  ///< which of them had no effect, and why
  observe::Use before, after;      ///< use of the machine until `begun`, until `ended`

  /// The time now, counted as the user counts it.
  double since_begun_s() const { return (machine::this_process().now() - begun).value; }

  // Called by the process: the first task is at hand, one more is in the farm, the interactive
  // phase is over, all is shown.
  void begin();
  void note_task(std::size_t in_farm);
  /// One more order of the user's has come. Returns whether it is to be obeyed: not after the end,
  /// nor where there is a reason why it has no effect.
  bool note_order(const std::string& why_without_effect = {});
  /// A ray that an order has admitted has changed the picture.
  void note_changed(std::uint8_t order);
  void end_interactive();
  void begin_interactive();  ///< again
  void end();
  /// The run has been cut short: what has not come yet came now.
  void cut();
};

}  // namespace farm

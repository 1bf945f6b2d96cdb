#pragma once
// Progress of the farm's coordination, in the user's time.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/trace/render.hpp"
#include "simulator/observe/use.hpp"

namespace farm {

/// Progress of a coordination. Always up to date, so that a run can be cut short.
struct Progress {
  enum class Phase { setup, interactive, non_interactive, ended };

  explicit Progress(const machine::Machine& machine) : observed(machine) {}

  const machine::Machine& observed;
  Phase phase = Phase::setup;
  bool is_null = false;  ///< no ray is left within the limits; the user may still give orders
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_since, ended;
  double interactive_s = 0;    ///< excludes the time since `interactive_since`
  machine::Seconds last_task;  ///< time of the last task handed out
  std::uint64_t tasks = 0;     ///< handed out
  std::size_t peak_tasks_in_farm = 0;
  std::size_t orders = 0;  ///< orders received from the user
  /// Time of each order, and of the first pixel changed by a ray that it admitted.
  std::vector<std::pair<machine::Seconds, std::optional<machine::Seconds>>> orders_shown;
  bool is_aborted = false;         ///< by the user
  std::vector<std::string> notes;  ///< orders without effect, with the reason
  observe::Use before, after;      ///< use of the machine until `begun` and until `ended`

  /// Time since the first task was ready, as the user counts it.
  double since_begun_s() const { return (machine::this_process().now() - begun).value; }

  // Called by the process: begin() with the first task ready, note_task() for each task,
  // end_interactive() after that phase, end() with the image complete.
  void begin();
  void note_task(std::size_t in_farm);
  /// Counts an order and returns whether to obey it: false after the end, or if
  /// `why_without_effect` gives a reason.
  bool note_order(const std::string& why_without_effect = {});
  /// Notes that a ray admitted by `order` changed the picture.
  void note_changed(std::uint8_t order);
  void end_interactive();
  void begin_interactive();  ///< the user returned to this phase
  void end();
  /// Closes a run that was cut short: events still missing get the current time.
  void cut();
};

}  // namespace farm

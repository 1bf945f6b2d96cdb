#pragma once
// Progress of the farm's coordination process, in the user's time.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/trace/render.hpp"
#include "simulator/observe/use.hpp"

namespace farm {

/// Progress of the coordination process. Always up to date, so that a run can be cut short.
struct Progress {
  enum class Phase { setup, interactive, non_interactive, ended };

  explicit Progress(const machine::Machine& machine) : observed(machine) {}

  const machine::Machine& observed;
  Phase phase = Phase::setup;
  bool is_null = false;  ///< no ray within the limits is left, but the user may still give orders
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_since, ended;
  double interactive_s = 0;    ///< without the time since `interactive_since`
  machine::Seconds last_task;  ///< date at which the last task was sent
  std::uint64_t tasks = 0;     ///< number of tasks sent
  std::size_t peak_tasks_in_farm = 0;
  std::size_t orders = 0;  ///< number of orders received from the user
  /// For each order: its date, and the date at which a ray admitted by the order first changed a
  /// pixel.
  std::vector<std::pair<machine::Seconds, std::optional<machine::Seconds>>> orders_shown;
  bool is_aborted = false;         ///< true if the user aborted the run
  std::vector<std::string> notes;  ///< orders without effect, with reasons
  observe::Use before, after;      ///< use of the machine up to `begun` and up to `ended`

  /// The user's time: time since the first task was ready.
  double since_begun_s() const { return (machine::this_process().now() - begun).value; }

  // Called by the coordination process: begin() when the first task is ready, note_task() for each
  // task, end_interactive() after the interactive phase, end() when the image is complete.
  void begin();
  void note_task(std::size_t in_farm);
  /// Counts an order. Returns true if the order shall be executed: the run has not ended and
  /// `why_without_effect` is empty.
  bool note_order(const std::string& why_without_effect = {});
  /// Records that a ray admitted by `order` changed the picture.
  void note_changed(std::uint8_t order);
  void end_interactive();
  void begin_interactive();  ///< called when the user returns to the interactive phase
  void end();
  /// Ends the record of a run that was cut short: missing dates become the present date.
  void cut();
};

}  // namespace farm

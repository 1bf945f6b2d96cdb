#pragma once
// Progress of the farm's coordination process.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/trace/render.hpp"
#include "simulator/farm/rays/ray_stores.hpp"
#include "simulator/observe/use.hpp"

namespace farm {

/// Progress of the coordination process, up to date at every moment, so that a run can be cut
/// short.
struct Progress {
  enum class Phase { setup, interactive, non_interactive, ended };

  explicit Progress(const machine::Machine& machine) : observed(machine) {}

  const machine::Machine& observed;
  Limits limits;  ///< limits in force
  Phase phase = Phase::setup;
  bool is_null = false;  ///< no ray within the limits is left, and the process waits for an order
  renderer::RayCounts rays;
  machine::Seconds begun, interactive_since, ended;
  double interactive_s = 0;    ///< duration in s of the interactive phases that have ended
  machine::Seconds last_task;  ///< date at which the last task was sent
  std::uint64_t tasks = 0;     ///< number of tasks sent
  std::size_t peak_tasks_in_farm = 0;
  std::size_t orders = 0;  ///< number of orders received from the user
  /// For each order of the user: the date of its arrival, and the date at which a ray admitted by
  /// the order first changed a pixel (empty until then).
  std::vector<std::pair<machine::Seconds, std::optional<machine::Seconds>>> orders_shown;
  bool is_aborted = false;         ///< true if the user aborted the run
  std::vector<std::string> notes;  ///< messages about orders without effect, with the reasons
  observe::Use before, after;  ///< use of processors and links up to the dates `begun` and `ended`

  /// The user's time in seconds, which starts when the first task is ready.
  double since_begun_s() const { return (machine::this_process().now() - begun).value; }

  // The coordination process calls begin() when the first task is ready, note_task() for each task,
  // end_interactive() after the interactive phase, and end() when the image is complete.
  void begin();
  void note_task(std::size_t in_farm);
  /// Counts an order of the user. Returns true if it must be executed. Otherwise adds a note:
  /// either the run has ended, or `why_without_effect` gives the reason.
  bool note_order(const std::string& why_without_effect = {});
  /// Records that a ray admitted by order number `order` (from 1) changed the picture.
  void note_changed(std::uint8_t order);
  void note_abort();
  void end_interactive();
  void begin_interactive();  ///< the user returned to the interactive phase
  void end();
  /// Completes the record of a run that was cut short: missing dates become the present date.
  void cut();
};

}  // namespace farm

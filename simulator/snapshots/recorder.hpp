#pragma once
// Recorder of the displayed picture while it grows. It works outside the machine and takes no
// simulated time.
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "simulator/observe/run_monitor.hpp"

namespace snapshots {

/// The displayed picture at a given time.
struct Snapshot {
  double at_s = 0;                           ///< time since the first task
  std::optional<std::uint64_t> rays = {};    ///< number of rays shown
  std::optional<std::uint64_t> cycles = {};  ///< cycles charged to kernels so far
  std::vector<std::uint8_t> rgb8;
};

/// Times for recording the picture.
struct Schedule {
  std::vector<double> at_s;  ///< times since the first task, ascending
  double every_s = 0;        ///< also at multiples of this, at most 1000 of them; 0: at none
  int growth = 0;            ///< also at least so often, at equal intervals; 0: never
};

/// Records pictures at the times of `looks`. The picture changes only when the display paints; each
/// change is preceded by a call of note().
class Recorder {
 public:
  /// `monitor`: its observer is also notified before each change; may be null.
  explicit Recorder(Schedule snapshot_times, const observe::RunMonitor* monitor = nullptr);

  /// Notes the picture valid from the last call until `now_s`. `look` returns it; the recorder sets
  /// its time. Called by the painting process.
  void note(double now_s, const std::function<Snapshot()>& look);
  /// The same for the last picture at the end, which also ends the growth.
  void end(double now_s, const std::function<Snapshot()>& look);

  /// Pictures at the requested times, and those of the growth.
  const std::vector<Snapshot>& pictures() const { return pictures_; }
  const std::vector<Snapshot>& growth() const { return growth_; }

 private:
  double next_picture_s() const;
  void take(double now_s, const std::function<Snapshot()>& look);

  Schedule schedule_;
  const observe::RunMonitor* monitor_;
  std::size_t next_at_ = 0;
  std::int64_t next_multiple_ = 1;
  double growth_interval_s_ = 1e-3;
  std::int64_t next_growth_ = 0;  // in intervals
  std::vector<Snapshot> pictures_, growth_;
};

}  // namespace snapshots

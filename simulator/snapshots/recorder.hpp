#pragma once
// Recorder of the growing picture on the display. It is outside the simulated machine, so it takes
// no simulated time.
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "simulator/observe/run_monitor.hpp"

namespace snapshots {

/// The displayed picture at one moment.
struct Snapshot {
  double at_s = 0;                           ///< seconds since the first task
  std::optional<std::uint64_t> rays = {};    ///< number of rays shown in the picture
  std::optional<std::uint64_t> cycles = {};  ///< cycles charged for kernels so far
  std::vector<std::uint8_t> rgb8;
};

/// Times at which the picture is recorded.
struct Schedule {
  std::vector<double> at_s;  ///< times in seconds since the first task, ascending
  /// Interval in s between further times, of which there are at most 1000; 0 for none.
  double every_s = 0;
  int growth = 0;  ///< minimum number of further times, at equal intervals; 0 for none
};

/// Records pictures at the times of a Schedule. The display must call note() before each change of
/// its picture.
class Recorder {
 public:
  /// `monitor` may be null. If it has an observer, note() also tells this observer of each change.
  explicit Recorder(Schedule snapshot_times, const observe::RunMonitor* monitor = nullptr);

  /// Records the picture if a recording time lies between the previous call and `now_s`. `look`
  /// returns the picture; the recorder fills in its time. Must be called by the process that
  /// paints.
  void note(double now_s, const std::function<Snapshot()>& look);
  /// Records the final picture. No recording may follow.
  void end(double now_s, const std::function<Snapshot()>& look);

  /// pictures() returns the pictures for Schedule::at_s and Schedule::every_s, growth() those for
  /// Schedule::growth.
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
  std::int64_t next_growth_ = 0;  // number of intervals up to the next picture of growth_
  std::vector<Snapshot> pictures_, growth_;
};

}  // namespace snapshots

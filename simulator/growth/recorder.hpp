#pragma once
// What the display shows while a picture grows, looked at from outside the machine: it costs no
// simulated time.
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "simulator/observe/watch.hpp"

namespace growth {

/// The picture as it was shown at a time.
struct Shown {
  double at_s = 0;                           ///< from the first task
  std::optional<std::uint64_t> rays = {};    ///< that it shows
  std::optional<std::uint64_t> cycles = {};  ///< that kernels had been charged
  std::vector<std::uint8_t> rgb8;
};

/// When the picture is to be looked at.
struct Looks {
  std::vector<double> at_s;  ///< from the first task, ascending
  double every_s = 0;        ///< and at each multiple of this, up to 1000; 0: at none
  int growth = 0;            ///< and at least so many times at equal intervals; 0: never
};

/// Takes pictures at the times of `looks`. A picture changes only when the display paints: it is
/// told before each time what it shows until then.
class Recorder {
 public:
  /// `watch`: who is told, too, before the picture changes; null: nobody.
  explicit Recorder(Looks looks, const observe::Watch* watch = nullptr);

  /// From the last call until `now_s` the picture was this. `look` makes it; its time is set here.
  /// The process that paints calls it.
  void note(double now_s, const std::function<Shown()>& look);
  /// The same, of the last picture at the end; its growth ends with it.
  void end(double now_s, const std::function<Shown()>& look);

  /// At the times that were asked for, and those of the growth.
  const std::vector<Shown>& pictures() const { return pictures_; }
  const std::vector<Shown>& growth() const { return growth_; }

 private:
  double next_picture_s() const;
  void take(double now_s, const std::function<Shown()>& look);

  Looks looks_;
  const observe::Watch* watch_;
  std::size_t next_at_ = 0;
  std::int64_t next_multiple_ = 1;
  double growth_interval_s_ = 1e-3;
  std::int64_t next_growth_ = 0;  // intervals
  std::vector<Shown> pictures_, growth_;
};

}  // namespace growth

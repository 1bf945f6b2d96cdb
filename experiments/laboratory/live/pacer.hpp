#pragma once
// Pace of a live run: simulated time per host time.
#include <chrono>
#include <cmath>
#include <limits>

namespace laboratory {

/// Times are in simulated seconds. The speed is in simulated seconds per second of host time;
/// infinite: as fast as possible.
class Pacer {
 public:
  using HostClock = std::chrono::steady_clock;

  explicit Pacer(double speed) : speed_(speed), since_(HostClock::now()) {}

  /// From now on, lets simulated time pass from `from_s` at `speed` times real time.
  void start(double from_s, double speed) {
    from_s_ = from_s;
    speed_ = speed;
    since_ = HostClock::now();
    free_until_s_ = 0;
  }
  /// Sets the simulated time of an unpaced run.
  void set_time(double s) { from_s_ = s; }

  double speed() const { return speed_; }
  bool is_unlimited() const { return std::isinf(speed_); }
  /// The simulated time of start() or set_time().
  double from_s() const { return from_s_; }
  /// The simulated time that the speed permits at present.
  double paced_s() const {
    const std::chrono::duration<double> since = HostClock::now() - since_;
    return from_s_ + since.count() * speed_;
  }

  /// True if hold_back() need not be called for an event at `date`.
  bool is_free(double date) const { return date < free_until_s_; }
  void set_free() { free_until_s_ = std::numeric_limits<double>::infinity(); }
  /// If the speed forbids the event at `date` for now, returns the host time to wait before the
  /// next attempt, which is at most `longest`. Otherwise returns zero.
  HostClock::duration hold_back(double date, HostClock::duration longest) {
    // host time by which the run may fall behind before its pace is reset
    constexpr double MOST_ARREARS_S = 0.25;
    double allowed_s = paced_s();
    if (date > allowed_s) {
      const std::chrono::duration<double> left((date - allowed_s) / speed_);
      return left < longest ? std::chrono::ceil<HostClock::duration>(left) : longest;
    }
    if (allowed_s - date > MOST_ARREARS_S * speed_) {
      start(date, speed_);
      allowed_s = date;
    }
    free_until_s_ = allowed_s;
    return {};
  }

 private:
  double speed_;
  HostClock::time_point since_;
  double from_s_ = 0;        // simulated time at the host time since_
  double free_until_s_ = 0;  // simulated time before which pacing needs no check
};

}  // namespace laboratory

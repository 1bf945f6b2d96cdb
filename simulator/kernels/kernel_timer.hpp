#pragma once
// Measurement of a kernel's time on the host. There are three difficulties: a call is often shorter
// than a reading of the clock, other events of the simulation have filled the caches, and other
// programs slow the host by varying amounts. The solutions: - Calls are stored as functions that
// repeat them, and measured in batches of 2 ms or 8192 calls.
//   A call of 2 ms or more is a batch by itself.
// - A batch runs several times, each time between two runs of a yardstick, a kernel with constant
//   work. The median of the ratios is the batch's time in yardsticks.
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

namespace kernels {

/// Clock and reference times for the timing of kernels.
struct Host {
  std::function<double()> now_s;    ///< clock
  std::function<void()> yardstick;  ///< a kernel with constant work
  double interval_s = 0;            ///< time between two consecutive readings of the clock
  double call_s = 0;                ///< time of an empty replay's call in a batch
  double yardstick_s = 0;           ///< time of a yardstick run, measured at the start
};
/// CPU time of this thread, s; it stands still while other programs run.
double host_cpu_s();
/// Time between two consecutive readings of host_cpu_s(), s.
double clock_interval_s();
/// This host: clock host_cpu_s(); yardstick: rays through a scene of spheres. The first call
/// measures its speed. Processes forked afterwards inherit it, so that their times are comparable.
const Host& this_host();

/// Functions that repeat calls, stored contiguously in memory. If scattered like a simulation's
/// other allocations, short calls would include the cache misses to reach them.
class Replays {
 public:
  Replays() = default;
  Replays(const Replays&) = delete;
  Replays& operator=(const Replays&) = delete;
  ~Replays() { clear(); }

  template <class Function>
  void add(Function function) {
    void* place = memory_.allocate(sizeof(Function), alignof(Function));
    calls_.push_back({::new (place) Function(std::move(function)),
                      [](void* f) { (*static_cast<Function*>(f))(); },
                      [](void* f) { std::destroy_at(static_cast<Function*>(f)); }});
  }
  void run() const {
    for (const auto& call : calls_) call.run(call.function);
  }
  std::size_t size() const { return calls_.size(); }
  void clear() {
    for (const auto& call : calls_) call.destroy(call.function);
    calls_.clear();
    memory_.release();
  }

 private:
  struct Call {
    void* function;
    void (*run)(void*);
    void (*destroy)(void*);
  };
  std::pmr::monotonic_buffer_resource memory_{1 << 16};
  std::vector<Call> calls_;
};

/// Times the calls of one kernel. A call is charged its weight times the last batch's time per unit
/// of weight. Corrections of up to a fifth make the sum over many calls equal to their measured
/// time.
class KernelTimer {
 public:
  explicit KernelTimer(const Host& host) : host_(host) {}

  static constexpr double BATCH_S = 2e-3;          ///< target duration of a batch
  static constexpr std::size_t MOST_CALLS = 8192;  ///< maximum calls of a batch
  static constexpr int REPEATS = 5;
  /// Minimum measured interval, in clock intervals.
  static constexpr double LEAST_INTERVALS = 50;

  /// Time of a call, in s on a host with the speed at which Host::yardstick_s was measured. Each
  /// call of `replay` repeats the same work. `weight` > 0 is the work relative to other calls:
  /// counted cycles, or 1.
  template <class Replay>
  double eval(Replay replay, double weight) {
    batch_.add(std::move(replay));
    weight_ += weight;
    if (batch_.size() >= full_ || batch_about_s_ + weight * s_per_weight_ >= BATCH_S) measure();
    return charge(weight * s_per_weight_);
  }

  /// Duration of the longest batch, s.
  double longest_batch_s() const { return longest_batch_s_; }
  /// True if no batch had MOST_CALLS or lasted long enough for the clock. Calls were then repeated
  /// on the same few inputs, already known to caches and branch predictors.
  bool is_short() const { return most_calls_ < MOST_CALLS && longest_batch_s_ < least_s(); }

 private:
  double least_s() const { return LEAST_INTERVALS * host_.interval_s; }
  void measure();
  double charge(double about_s);
  double eval_batch_s(double once_s) const;
  double time(const std::function<void()>& run) const;
  void run_batch(int passes) const;
  double time_batch(int passes) const;
  double time_yardstick() const;

  const Host& host_;
  Replays batch_;
  double weight_ = 0;         // sum of the batch
  std::size_t full_ = 1;      // calls of a full batch: the first call is measured at once
  double s_per_weight_ = 0;   // in the last batch
  double batch_about_s_ = 0;  // estimated time of the batch
  double owed_s_ = 0;         // measured time of batches minus charged time
  double longest_batch_s_ = 0;
  std::size_t most_calls_ = 0;
};

}  // namespace kernels

#pragma once
// Measures the host time of a kernel (a numerical function of the renderer). This is difficult for
// three reasons: a call is often shorter than a reading of the clock, other work of the simulation
// has filled the caches, and other programs slow the host by varying amounts. The solutions:
// - Calls are stored as functions that repeat them, called replays. Replays are measured in batches
//   with a duration of 2 ms or with 8192 calls. A single call of at least 2 ms is a batch by
//   itself.
// - A batch runs several times, each time between two runs of a yardstick, which is a kernel with
//   constant work. The median of the ratios is the batch's time in units of yardstick runs.
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

namespace kernels {

/// Clock and reference times of the host.
struct Host {
  std::function<double()> now_s;    ///< the clock, in seconds
  std::function<void()> yardstick;  ///< runs a kernel whose work is constant
  double interval_s = 0;            ///< time between two consecutive readings of the clock, in s
  double call_s = 0;                ///< time of calling an empty replay in a batch, in s
  double yardstick_s = 0;           ///< time of a yardstick run in s, measured at start-up
};
/// CPU time of this thread in seconds. Does not advance while other programs use the CPU.
double host_cpu_s();
/// Time between two consecutive readings of host_cpu_s(), in seconds.
double clock_interval_s();
/// The Host of this machine, with the clock host_cpu_s() and a yardstick that traces rays through
/// spheres. The first call measures the yardstick. Processes forked afterwards inherit the result,
/// so that their times are comparable.
const Host& this_host();

/// Stored functions (replays). Each of them repeats one call of a kernel. They lie contiguously in
/// memory. If they were scattered among the simulation's other allocations, cache misses would
/// dominate the time of short calls.
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

/// Measures the calls of one kernel. The time charged for a call is its weight, multiplied by the
/// time per unit of weight in the previous batch. Each charge is corrected by at most a fifth, so
/// that the sum of many charges equals the measured time of their calls.
class KernelTimer {
 public:
  explicit KernelTimer(const Host& host) : host_(host) {}

  static constexpr double BATCH_S = 2e-3;          ///< target duration of a batch
  static constexpr std::size_t MOST_CALLS = 8192;  ///< maximum number of calls in a batch
  static constexpr int REPEATS = 5;
  /// Minimum duration of a measurement, in units of Host::interval_s.
  static constexpr double LEAST_INTERVALS = 50;

  /// Returns the time of a call in seconds, for a host as fast as when Host::yardstick_s was
  /// measured. `replay` must do the same work each time it is called. `weight` > 0 is the amount of
  /// work compared with other calls, for instance the number of counted cycles.
  template <class Replay>
  double eval(Replay replay, double weight) {
    batch_.add(std::move(replay));
    weight_ += weight;
    if (batch_.size() >= full_ || batch_about_s_ + weight * s_per_weight_ >= BATCH_S) measure();
    return charge(weight * s_per_weight_);
  }

  /// Duration of the longest batch in seconds.
  double longest_batch_s() const { return longest_batch_s_; }
  /// True if no batch had MOST_CALLS calls or lasted long enough for the clock. The measured calls
  /// then had few different inputs, which caches and branch predictors already knew.
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
  double weight_ = 0;         // total weight of the calls in the batch
  std::size_t full_ = 1;      // number of calls that make a batch full
  double s_per_weight_ = 0;   // time per unit of weight in the last batch, seconds
  double batch_about_s_ = 0;  // estimated time of the batch in s
  double owed_s_ = 0;         // measured time of batches minus charged time, in s
  double longest_batch_s_ = 0;
  std::size_t most_calls_ = 0;
};

}  // namespace kernels

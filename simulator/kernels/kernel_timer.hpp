#pragma once
// How long a kernel takes on the host. Three things are in the way. A call is often shorter than a
// reading of the clock; after the events of a simulation it finds caches that others have filled;
// and what else runs on the host makes it slower, now more and now less. So
// - calls are kept, as functions that do the same again, and measured in batches: as many as last
//   2 ms, or 8192; a call that lasts as long by itself is a batch;
// - a batch is run several times, each time between two runs of a yardstick, a kernel that does
//   always the same: the median of their ratios is what the batch takes in yardsticks.
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

namespace kernels {

/// What kernels are timed with.
struct Host {
  std::function<double()> now_s;    ///< clock
  std::function<void()> yardstick;  ///< a kernel that does always the same
  double interval_s = 0;            ///< between two readings with nothing between
  double call_s = 0;                ///< a call of a replay that does nothing, in a batch
  double yardstick_s = 0;           ///< a run of the yardstick, when it was measured
};
/// CPU time of this thread, s, which stands still while other programs run.
double host_cpu_s();
/// Between two readings of it with nothing between.
double clock_interval_s();
/// This host: host_cpu_s(), and rays through a scene of spheres. Its speed is measured at the first
/// call, and the same for processes that are forked after it: their times compare.
const Host& this_host();

/// Functions that do a call's work again, one behind the other in memory: spread over it, as what a
/// simulation allocates is, short ones would be measured with the way to them.
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

/// Times the calls of one kernel. A call takes its weight times what a unit of weight took in the
/// last batch, and up to a fifth more or less until all that batches took is charged: the sum over
/// many calls is what they take.
class KernelTimer {
 public:
  explicit KernelTimer(const Host& host) : host_(host) {}

  static constexpr double BATCH_S = 2e-3;          ///< a batch lasts so long, unless
  static constexpr std::size_t MOST_CALLS = 8192;  ///< it has so many calls
  static constexpr int REPEATS = 5;
  /// An interval that is measured lasts at least so many of the clock's own.
  static constexpr double LEAST_INTERVALS = 50;

  /// The time of a call, s of a host as fast as it was when Host::yardstick_s was measured.
  /// `replay` does the same work again as often as it is called; `weight` > 0 says how much that is
  /// beside other calls: counted cycles, or 1.
  template <class Replay>
  double eval(Replay replay, double weight) {
    batch_.add(std::move(replay));
    weight_ += weight;
    if (batch_.size() >= full_ || batch_about_s_ + weight * s_per_weight_ >= BATCH_S) measure();
    return charge(weight * s_per_weight_);
  }

  /// The longest batch took so long, s.
  double longest_batch_s() const { return longest_batch_s_; }
  /// No batch had MOST_CALLS, or was as long as the clock needs: calls were repeated on the inputs
  /// of a few, which caches and branch predictors knew then.
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
  double weight_ = 0;         // of the batch
  std::size_t full_ = 1;      // calls of a full batch: the first is measured at once
  double s_per_weight_ = 0;   // in the last batch
  double batch_about_s_ = 0;  // what the batch is thought to take
  double owed_s_ = 0;         // what batches took beyond what was charged
  double longest_batch_s_ = 0;
  std::size_t most_calls_ = 0;
};

}  // namespace kernels

#pragma once
// A process of a simulated transputer: a body that spends cycles. It has its own stack, or none if
// it is a Proc.
#include <array>
#include <boost/intrusive/list_hook.hpp>
#include <functional>
#include <string>
#include <vector>

#include "simulator/machine/carriers/coroutine.hpp"
#include "simulator/machine/proc.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

class Process;
class Processor;

enum class Priority : std::uint8_t { high, low };

using ProcessId = std::uint64_t;  ///< unique in a machine; 0 is no process

/// A change of a CPU's speed at date `now`: it moves future dates, and keeps past ones.
struct Stretch {
  Seconds now{};
  double ratio = 1;  ///< durations afterwards over durations before
  Seconds operator()(Seconds date) const { return date > now ? now + ratio * (date - now) : date; }
};

/// Reason why a process is blocked.
struct Wait {
  enum class Kind : std::uint8_t { other, output, input, alternative };

  /// Text for a deadlock report: "in on worker3.from.left".
  virtual std::string describe() const = 0;
  /// Known processes that could end the wait (any one suffices); they may have ended.
  virtual std::vector<ProcessId> waits_for() const { return {}; }
  virtual Kind kind() const { return Kind::other; }
  /// Called after a cut of a link of the processor. Ends the wait of `process` if it waits for that
  /// link and its operation may fail.
  virtual void on_cut(Process& process) { static_cast<void>(process); }
  /// Called when blocked_since() of `process`, a date ahead of the clock, has moved.
  virtual void on_stretch(Process& process, const Stretch& stretch) {
    static_cast<void>(process), static_cast<void>(stretch);
  }

 protected:
  ~Wait() = default;
};

/// Charged cycles accumulate in a debt, so that a process's own time may be ahead of the clock. It
/// pays when it blocks or on request (sync, now). A high-priority process cannot lose the CPU: its
/// own time is certain, it meets others by time stamps and seldom needs to sync. A low-priority one
/// can lose the CPU at any instant, so it syncs before any action visible to others.
class Process {
 public:
  enum class State : std::uint8_t { ready, running, blocked, ended };
  using Body = Coroutine::Body;
  using ReadyHook = boost::intrusive::list_member_hook<
      boost::intrusive::link_mode<boost::intrusive::normal_link>>;

  Process(Processor& processor, std::string name, Priority priority, Body body);
  Process(Processor& processor, std::string name, Priority priority, Proc proc);
  ~Process();  ///< unwinds a body that has not ended
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // --- called by the process itself ---------------------------------------------------------
  /// Spends cycles of the CPU, or a duration rounded to whole cycles. Pre-emption and the links'
  /// DMA come on top. Simulated time passes at the next sync, now or block.
  void charge(Cycles cycles) {
    debt_ += cycles;
    if (debt_ > MUCH_DEBT) sync_if_much();
  }
  void charge(Seconds duration);
  /// Pays the debt: on return the clock has reached this process's own time, and it has the CPU.
  /// Returns whether others may have run meanwhile.
  bool sync() {
    const bool must = must_sync();
    if (must) suspend();
    return must;
  }
  /// Marks the last instruction of a process that has paid. Only the end of its body follows, even
  /// if a process made ready by the instruction takes the CPU.
  void end_by_this() { ends_by_this_ = true; }
  /// Gives the CPU up until Processor::make_ready. A low-priority process must have paid before.
  void block(Wait& wait);
  /// Carries an operation out to its end and returns it. After its first wait the operation runs
  /// without the body's stack: it must neither sync nor block.
  template <class SomeOperation>
  SomeOperation&& carry_out(SomeOperation&& operation) {
    require_stack();
    if (!operation.go_on(*this)) suspend_in(operation);
    return std::forward<SomeOperation>(operation);
  }

  // --- called by operations -------------------------------------------------------------------
  /// True if sync() would give the CPU up. The operation then returns that it is not over, and does
  /// not call this again when it goes on.
  inline bool must_sync() const;
  /// The same before it meets others: a high process syncs only if its debt is large.
  bool must_sync_if_long() const {
    return (priority_ == Priority::low || owes_much()) && must_sync();
  }
  bool owes_much() const { return debt_ > LONG_DEBT; }
  /// Mean duration of a cycle in the last payment. Transfers that start or end during the payment
  /// change it, but not those at the instant of payment.
  Seconds paid_cycle() const {
    return {paid_for_.value / static_cast<double>(std::max<std::int64_t>(1, paying_.value))};
  }
  /// Rank of the end of its computation among simultaneous events, see Events. A process with a
  /// rank reaches a link as soon as it has paid.
  static constexpr std::uint64_t NO_RANK = ~std::uint64_t{0};
  void set_rank(std::uint64_t rank) { rank_ = rank; }
  bool has_rank() const { return rank_ != NO_RANK; }
  /// True if the process runs on a stack of its own, so that it may wait at any point.
  bool has_stack() const { return coroutine_ && !operation_; }
  /// Marks the process as blocked from its own time on, see block().
  void start_wait(Wait& wait);
  // --------------------------------------------------------------------------------------------

  /// Pays the debt, and returns the time. Throws Misuse outside of this process.
  Seconds now();
  /// The clock plus the time to pay the debt without pre-emption and with the links' present DMA;
  /// exact for a process that has just paid. A stored date ahead of the clock must be stretched,
  /// see Wait::on_stretch.
  inline Seconds own_time() const;

  Processor& processor() { return processor_; }
  const Processor& processor() const { return processor_; }
  ProcessId id() const { return id_; }
  const std::string& name() const { return name_; }
  Priority priority() const { return priority_; }
  State state() const { return state_; }
  /// Marks a process that runs for ever: the run is done when all others have ended and the server
  /// waits for input.
  void set_server() { is_server_ = true; }
  bool is_server() const { return is_server_; }
  /// Number of times it has blocked, to distinguish one wait from the next.
  std::uint64_t waits() const { return waits_; }
  const Wait* wait() const {
    return wait_;
  }  ///< current wait of a blocked process; null before its start
  Wait::Kind waits_for() const { return waits_for_; }  ///< kind of its last wait
  /// Notifies a blocked process of the cut of a link.
  void tell_cut() {
    if (state_ == State::blocked && wait_) wait_->on_cut(*this);
  }
  Seconds blocked_since() const { return blocked_since_; }  ///< own_time() at its last wait's start
  /// Total time in waits of this kind so far, including the current wait.
  Seconds blocked(Wait::Kind kind) const;
  std::uint32_t trace_id() const { return trace_id_; }  ///< see Observer

 private:
  friend class Cpu;
  friend class Processor;
  friend Process& this_process();
  static constinit inline thread_local Process* executing = nullptr;
  static constexpr Cycles LONG_DEBT{1000}, MUCH_DEBT{1 << 20}, MOST_DEBT{1 << 30};
  void sync_if_much();
  void require_stack() const {
    if (!has_stack()) throw_without_stack();
  }
  [[noreturn]] void throw_without_stack() const;
  void resume();   // called by the CPU: enters the body, until it suspends or ends
  void suspend();  // called by the body: returns to the CPU
  void leave_body();
  void suspend_in(Operation& operation);
  bool go_on_in_operation();  // returns whether it is over
  void stretch(const Stretch& stretch);
  void note_end_of_run();
  void live();     // runs the body to its end
  void live_on();  // the same without a stack, from its last point

  // Members used by every wait and wake-up come first, in the same cache lines of the host.
  Processor& processor_;
  State state_ = State::blocked;
  Priority priority_;
  Wait::Kind waits_for_{};
  bool cancelled_ = false, is_server_ = false, ends_by_this_ = false;
  ReadyHook ready_hook_;  // in its ready queue
  Cycles debt_{};
  Seconds ready_at_{};                    // date of joining its ready queue
  Proc proc_;                             // a body without a stack
  std::unique_ptr<Coroutine> coroutine_;  // a body with a stack
  Operation* operation_ = nullptr;        // current operation of a body with a stack
  Wait* wait_ = nullptr;
  Seconds blocked_since_{};
  std::uint64_t waits_ = 0;
  std::array<Seconds, 4> blocked_{};  // time in past waits, by Wait::Kind
  ProcessId id_;
  Cycles paying_{};      // current or last payment of the debt
  Seconds paid_for_{};   // time spent on it so far
  Seconds remaining_{};  // computation left of a low-priority process that lost the CPU
  std::uint64_t rank_ = NO_RANK;
  int wake_ups_ = 0;  // pending events of Processor::wake_at
  std::uint32_t trace_id_ = 0;
  std::exception_ptr failure_;  // exception of its operation
  Body body_;
  std::string name_;
};

/// co_await Sync(): Process::sync() for a Proc.
class [[nodiscard]] Sync final : public Operation {
 public:
  bool go_on(Process& self) override {
    return std::exchange(has_begun_, true) || !self.must_sync();
  }

 private:
  bool has_begun_ = false;
};

[[noreturn]] void throw_outside_of_process();
/// The currently executing process. Throws InvariantBroken outside of any process.
inline Process& this_process() {
  if (!Process::executing) throw_outside_of_process();
  return *Process::executing;
}

}  // namespace machine

#pragma once
// A process of a simulated transputer, which uses cycles of its CPU. Its body has a stack of its
// own, or is a Proc, which needs none.
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

using ProcessId = std::uint64_t;  ///< unique within a machine; 0 means no process

/// Change of a CPU's speed at the date `now`. Maps a future date that was computed with the old
/// speed to the date with the new speed. Past dates stay unchanged.
struct Stretch {
  Seconds now{};
  double ratio = 1;  ///< new duration divided by old duration
  Seconds operator()(Seconds date) const { return date > now ? now + ratio * (date - now) : date; }
};

/// Describes what a blocked process waits for.
struct Wait {
  enum class Kind : std::uint8_t { other, output, input, alternative };

  /// Text for a deadlock report, such as "in on worker3.from.left".
  virtual std::string describe() const = 0;
  /// The processes of which any one could end the wait, as far as they are known. Some of them may
  /// have ended.
  virtual std::vector<ProcessId> waits_for() const { return {}; }
  virtual Kind kind() const { return Kind::other; }
  /// Called after a link of the processor has been cut. Ends the wait of `process` if it waits for
  /// this link and its operation is one that may fail.
  virtual void on_cut(Process& process) { static_cast<void>(process); }
  /// Called after blocked_since() of `process` has changed, which happens only to dates ahead of
  /// the clock.
  virtual void on_stretch(Process& process, const Stretch& stretch) {
    static_cast<void>(process), static_cast<void>(stretch);
  }

 protected:
  ~Wait() = default;
};

/// A process first executes its code on the host and only counts the cycles that it is charged, as
/// a debt. Its own time, which includes this debt, may therefore be ahead of the clock. It pays the
/// debt (lets the simulated time pass) when it blocks, or on request by sync() or now(). A
/// high-priority process cannot lose the CPU, so its own time is certain: it passes its own time to
/// other processes and seldom needs to sync. A low-priority process can lose the CPU at any time,
/// so it syncs before any action that other processes can observe.
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
  /// Charges the process with cycles, or with a duration rounded to whole cycles. Pre-emption and
  /// DMA of links take additional time. Simulated time passes at the next call of sync(), now() or
  /// block().
  void charge(Cycles cycles) {
    debt_ += cycles;
    if (debt_ > MUCH_DEBT) sync_if_much();
  }
  void charge(Seconds duration);
  /// Pays the debt: lets simulated time pass for the cycles that the process was charged.
  /// Afterwards the clock has reached the process's own time, and the process has the CPU. Returns
  /// true if other processes may have run meanwhile.
  bool sync() {
    const bool must = must_sync();
    if (must) suspend();
    return must;
  }
  /// Declares that the process has no unpaid cycles and now executes its last instruction. If this
  /// instruction makes a process ready that takes the CPU, the body nevertheless ends first.
  void end_by_this() { ends_by_this_ = true; }
  /// Yields the CPU until Processor::make_ready is called. A low-priority process must have paid
  /// its debt (called sync()) before.
  void block(Wait& wait);
  /// Executes an operation completely and returns it. If the operation has to wait, it continues
  /// outside of the body's stack; it must then neither sync nor block.
  template <class SomeOperation>
  SomeOperation&& carry_out(SomeOperation&& operation) {
    require_stack();
    if (!operation.go_on(*this)) suspend_in(operation);
    return std::forward<SomeOperation>(operation);
  }

  // True if sync() would yield the CPU. An operation must then return false, and must not test this
  // again when it continues.
  inline bool must_sync() const;
  /// Like must_sync(), for operations that tell other processes this process's own time, which may
  /// then be ahead of the clock. For a high-priority process, true only if its debt of cycles is
  /// also larger than LONG_DEBT.
  bool must_sync_if_long() const {
    return (priority_ == Priority::low || owes_much()) && must_sync();
  }
  bool owes_much() const { return debt_ > LONG_DEBT; }
  /// Mean duration of a cycle while the debt was last paid. It is longer than a period of the CPU's
  /// clock if DMA took cycles. Includes the effect of all messages on links during the payment,
  /// except messages that started or ended exactly at its end.
  Seconds paid_cycle() const {
    return {paid_for_.value / static_cast<double>(std::max<std::int64_t>(1, paying_.value))};
  }
  /// Rank of the end of the process's computation among simultaneous events (see
  /// Events::ranked_at). A process with a rank reaches a link as soon as it has paid its debt.
  static constexpr std::uint64_t NO_RANK = ~std::uint64_t{0};
  void set_rank(std::uint64_t rank) { rank_ = rank; }
  bool has_rank() const { return rank_ != NO_RANK; }
  /// True if the process now executes on a stack of its own, so that it may wait anywhere.
  bool has_stack() const { return coroutine_ && !operation_; }
  /// Marks the process as blocked from its own time (own_time()) on; a part of block().
  void start_wait(Wait& wait);
  // --------------------------------------------------------------------------------------------

  /// Calls sync() and returns the date. Throws Misuse if another process calls it.
  Seconds now();
  /// The process's own time: the clock plus the time to pay the debt at the present speed and
  /// without pre-emption. It is exact if the debt has just been paid. Wait::on_stretch must update
  /// a stored own time that is ahead of the clock.
  inline Seconds own_time() const;

  Processor& processor() { return processor_; }
  const Processor& processor() const { return processor_; }
  ProcessId id() const { return id_; }
  const std::string& name() const { return name_; }
  Priority priority() const { return priority_; }
  State state() const { return state_; }
  /// Marks a process that runs for ever. The run is done when all other processes have ended and
  /// this one waits for input.
  void set_server() { is_server_ = true; }
  bool is_server() const { return is_server_; }
  /// Number of waits that have started, which identifies the present wait.
  std::uint64_t waits() const { return waits_; }
  const Wait* wait() const {
    return wait_;
  }  ///< the present wait of a blocked process; null before the process starts
  Wait::Kind waits_for() const { return waits_for_; }  ///< kind of the present or last wait
  /// Tells a blocked process that a link of its processor has been cut.
  void tell_cut() {
    if (state_ == State::blocked && wait_) wait_->on_cut(*this);
  }
  Seconds blocked_since() const { return blocked_since_; }  ///< own_time() when the wait began
  /// Total time in waits of this kind, including the present wait.
  Seconds blocked(Wait::Kind kind) const;
  /// The id of the process's name, see Observer.
  std::uint32_t trace_id() const { return trace_id_; }

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
  void resume();   // called by the CPU: runs the body until it suspends or ends
  void suspend();  // called by the body: returns control to the CPU
  void leave_body();
  void suspend_in(Operation& operation);
  bool go_on_in_operation();  // returns true when the operation is complete
  void stretch(const Stretch& stretch);
  void note_end_of_run();
  void live();     // executes a body with a stack, from start to end
  void live_on();  // continues a body without a stack, a Proc

  // Members used each time the process waits or is woken come first, so that they share cache
  // lines.
  Processor& processor_;
  State state_ = State::blocked;
  Priority priority_;
  Wait::Kind waits_for_{};
  bool cancelled_ = false, is_server_ = false, ends_by_this_ = false;
  ReadyHook ready_hook_;  // membership in a ready queue of the CPU
  Cycles debt_{};
  Seconds ready_at_{};                    // date at which it joined the ready queue
  Proc proc_;                             // the body, if it has no stack
  std::unique_ptr<Coroutine> coroutine_;  // the body, if it has a stack
  Operation* operation_ = nullptr;        // operation that a body with a stack waits for
  Wait* wait_ = nullptr;
  Seconds blocked_since_{};
  std::uint64_t waits_ = 0;
  std::array<Seconds, 4> blocked_{};  // total duration of past waits, by Wait::Kind
  ProcessId id_;
  Cycles paying_{};      // number of cycles that are, or were last, being paid
  Seconds paid_for_{};   // time spent so far on paying these cycles
  Seconds remaining_{};  // computation left to a low-priority process that lost the CPU
  std::uint64_t rank_ = NO_RANK;
  int wake_ups_ = 0;  // number of pending events scheduled by Processor::wake_at
  std::uint32_t trace_id_ = 0;
  std::exception_ptr failure_;  // exception thrown by `operation_`, to be rethrown in the body
  Body body_;
  std::string name_;
};

/// Lets a Proc sync: `co_await Sync()` does for a Proc what Process::sync() does for a body with a
/// stack.
class [[nodiscard]] Sync final : public Operation {
 public:
  bool go_on(Process& self) override {
    return std::exchange(has_begun_, true) || !self.must_sync();
  }

 private:
  bool has_begun_ = false;
};

[[noreturn]] void throw_outside_of_process();
/// The process whose body is executing. Throws InvariantBroken if there is none.
inline Process& this_process() {
  if (!Process::executing) throw_outside_of_process();
  return *Process::executing;
}

}  // namespace machine

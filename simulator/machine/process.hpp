#pragma once
// A process of a simulated transputer: a body that spends cycles, on a stack of its own or, if it
// is a Proc, without one.
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

using ProcessId = std::uint64_t;  ///< never given twice in a machine; 0 is no process

/// A change of a CPU's speed: dates of its future move, those that have passed stay.
struct Stretch {
  Seconds now{};
  double ratio = 1;  ///< durations afterwards over durations before
  Seconds operator()(Seconds date) const { return date > now ? now + ratio * (date - now) : date; }
};

/// What a blocked process waits for.
struct Wait {
  enum class Kind : std::uint8_t { other, output, input, alternative };

  /// For the report of a deadlock: "in on worker3.from.left".
  virtual std::string describe() const = 0;
  /// The processes any of which could end the wait, as far as they are known; they may have ended.
  virtual std::vector<ProcessId> waits_for() const { return {}; }
  virtual Kind kind() const { return Kind::other; }
  /// A link of the processor has been cut. If `process` waits for that link and is to be told, its
  /// wait ends.
  virtual void on_cut(Process& process) { static_cast<void>(process); }
  /// `process` waits from a date ahead of the clock, and that date, blocked_since(), has moved.
  virtual void on_stretch(Process& process, const Stretch& stretch) {
    static_cast<void>(process), static_cast<void>(stretch);
  }

 protected:
  ~Wait() = default;
};

/// Cycles are charged into a debt, so that a process's own time may be ahead of the clock. The debt
/// is paid when the process blocks, or asks for it (sync, now). A high-priority process cannot lose
/// the CPU, so its own time is certain: it meets others by time stamps and seldom needs to sync. A
/// low-priority one can lose it at any instant, so it syncs before anything that others could see.
class Process {
 public:
  enum class State : std::uint8_t { ready, running, blocked, ended };
  using Body = Coroutine::Body;
  using ReadyHook = boost::intrusive::list_member_hook<
      boost::intrusive::link_mode<boost::intrusive::normal_link>>;

  Process(Processor& processor, std::string name, Priority priority, Body body);
  Process(Processor& processor, std::string name, Priority priority, Proc proc);
  ~Process();  ///< a body that has not ended is unwound
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // --- called by the process itself ---------------------------------------------------------
  /// Spends cycles, or a duration rounded to whole cycles, of the CPU by itself: what pre-empts the
  /// process and the links' DMA come on top. Simulated time passes at the next sync, now or block.
  void charge(Cycles cycles) {
    debt_ += cycles;
    if (debt_ > MUCH_DEBT) sync_if_much();
  }
  void charge(Seconds duration);
  /// Pays the debt: on return the clock has reached this process's own time and it has the CPU.
  /// Returns whether others may have run meanwhile.
  bool sync() {
    const bool must = must_sync();
    if (must) suspend();
    return must;
  }
  /// Its last instruction: nothing follows but the end of its body, even if a process that the
  /// instruction makes ready takes the CPU. It has paid.
  void end_by_this() { ends_by_this_ = true; }
  /// Gives the CPU up until Processor::make_ready; a low-priority process must have paid.
  void block(Wait& wait);
  /// An operation, to its end; returns it. What it does after it has had to wait for the first time
  /// is done without the stack of the body: it must not sync nor block.
  template <class SomeOperation>
  SomeOperation&& carry_out(SomeOperation&& operation) {
    require_stack();
    if (!operation.go_on(*this)) suspend_in(operation);
    return std::forward<SomeOperation>(operation);
  }

  // --- called by operations -------------------------------------------------------------------
  /// Whether sync() would give the CPU up. If so, the operation returns that it is not over, and
  /// does not ask again when it goes on.
  inline bool must_sync() const;
  /// The same before it meets others: a high process syncs only if it owes much.
  bool must_sync_if_long() const {
    return (priority_ == Priority::low || owes_much()) && must_sync();
  }
  bool owes_much() const { return debt_ > LONG_DEBT; }
  /// Mean duration of one cycle of the debt that was paid last. A transfer that starts or ends
  /// within the payment changes it; one that does so at the instant of payment does not.
  Seconds paid_cycle() const {
    return {paid_for_.value / static_cast<double>(std::max<std::int64_t>(1, paying_.value))};
  }
  /// While it computes, or would, it has this rank among what happens at one date; see Events. Such
  /// a process comes to a link as soon as it has paid.
  static constexpr std::uint64_t NO_RANK = ~std::uint64_t{0};
  void set_rank(std::uint64_t rank) { rank_ = rank; }
  bool has_rank() const { return rank_ != NO_RANK; }
  /// Whether it executes on its stack, and may wait anywhere.
  bool has_stack() const { return coroutine_ && !operation_; }
  /// From now on it is blocked, see block().
  void start_wait(Wait& wait);
  // --------------------------------------------------------------------------------------------

  /// Pays the debt, and returns the time. Throws Misuse outside of this process.
  Seconds now();
  /// The clock plus the debt, as the CPU would pay it if nothing pre-empted the process and the
  /// links' DMA went on as now: exact for a process that has just paid. Dates ahead of the clock
  /// that are kept must be stretched, see Wait::on_stretch.
  inline Seconds own_time() const;

  Processor& processor() { return processor_; }
  const Processor& processor() const { return processor_; }
  ProcessId id() const { return id_; }
  const std::string& name() const { return name_; }
  Priority priority() const { return priority_; }
  State state() const { return state_; }
  /// A server runs for ever: when all other processes have ended and it waits for input, the run is
  /// done.
  void set_server() { is_server_ = true; }
  bool is_server() const { return is_server_; }
  /// The number of times it has blocked, which tells one wait from the next.
  std::uint64_t waits() const { return waits_; }
  const Wait* wait() const {
    return wait_;
  }  ///< what a blocked process waits for; null before its start
  Wait::Kind waits_for() const { return waits_for_; }  ///< in its last wait
  /// Tells a blocked process that a link has been cut.
  void tell_cut() {
    if (state_ == State::blocked && wait_) wait_->on_cut(*this);
  }
  Seconds blocked_since() const { return blocked_since_; }  ///< in its last wait, its own_time()
  /// How long it has been blocked so far in waits of this kind, the one under way included.
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
  void resume();   // the CPU enters the body, until it suspends or ends
  void suspend();  // the body returns to the CPU
  void leave_body();
  void suspend_in(Operation& operation);
  bool go_on_in_operation();  // returns whether it is over
  void stretch(const Stretch& stretch);
  void note_end_of_run();
  void live();     // the body, and its end
  void live_on();  // the same without a stack, from where it was

  // What every wait and wake-up touches comes first: the host fetches it together.
  Processor& processor_;
  State state_ = State::blocked;
  Priority priority_;
  Wait::Kind waits_for_{};
  bool cancelled_ = false, is_server_ = false, ends_by_this_ = false;
  ReadyHook ready_hook_;  // in its ready queue
  Cycles debt_{};
  Seconds ready_at_{};                    // when it joined its ready queue
  Proc proc_;                             // the body without a stack
  std::unique_ptr<Coroutine> coroutine_;  // of a body with a stack
  Operation* operation_ = nullptr;        // which that body waits in
  Wait* wait_ = nullptr;
  Seconds blocked_since_{};
  std::uint64_t waits_ = 0;
  std::array<Seconds, 4> blocked_{};  // in waits that are over, by Wait::Kind
  ProcessId id_;
  Cycles paying_{};      // debt being paid, or paid last
  Seconds paid_for_{};   // time spent on it so far
  Seconds remaining_{};  // computation left of a low-priority process that lost the CPU
  std::uint64_t rank_ = NO_RANK;
  int wake_ups_ = 0;  // Processor::wake_at still to come
  std::uint32_t trace_id_ = 0;
  std::exception_ptr failure_;  // of its operation
  Body body_;
  std::string name_;
};

/// co_await Sync(): what Process::sync() does, in a Proc.
class [[nodiscard]] Sync final : public Operation {
 public:
  bool go_on(Process& self) override {
    return std::exchange(has_begun_, true) || !self.must_sync();
  }

 private:
  bool has_begun_ = false;
};

[[noreturn]] void throw_outside_of_process();
/// The process whose body is executing. Throws InvariantBroken outside of any process.
inline Process& this_process() {
  if (!Process::executing) throw_outside_of_process();
  return *Process::executing;
}

}  // namespace machine

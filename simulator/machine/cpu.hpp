#pragma once
// A transputer's CPU with its two-priority scheduler, which on the chip is implemented in
// microcode.
//
// High-priority processes run until they block. Low-priority processes run only while no
// high-priority process is ready, and are pre-empted as soon as one becomes ready. Low-priority
// processes share the CPU by time slices: a running one yields after one to two slice periods if
// another one is ready. (INMOS T800 family; transputer data book.)
#include <algorithm>
#include <array>
#include <boost/intrusive/list.hpp>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "simulator/machine/engine.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/machine/process.hpp"

namespace machine {

class LinkDirection;

/// Interface of an observer of processors and links. Each call reports an activity that has ended.
struct Observer {
  enum class Doing : std::uint8_t { high, low, switching };

  virtual ~Observer() = default;
  /// Announces the name of a process. Processes with the same name on one processor share an id.
  /// Ids count from 0.
  virtual void name_process(const Processor& on, std::uint32_t id, const std::string& name) = 0;
  virtual void ran(const Processor& on, std::uint32_t id, Doing doing, Seconds from,
                   Seconds to) = 0;
  virtual void moved(const LinkDirection& link, const std::string& channel, std::uint64_t bytes,
                     Seconds from, Seconds to) = 0;
};

struct CpuUse {
  /// Execution time by priority; context switches count as high priority.
  Seconds busy_high{}, busy_low{};
  /// Idle time of the CPU lost to DMA and to a companion (a second processor on the same memory).
  /// If the CPU is busy, lost cycles extend its busy time instead.
  Seconds stolen_idle{};
  std::uint64_t preemptions = 0, dispatches = 0;
  Seconds busy() const { return busy_high + busy_low; }
  /// Time that would not have been available to an additional process of lowest priority. Excludes
  /// the switches that such a process would cause.
  Seconds taken() const { return busy() + stolen_idle; }
};

/// Buffer between a CPU and its observer. An activity may end at a date ahead of the clock, and DMA
/// may still change that date. Each activity is therefore reported after its end, or by flush().
class CpuDiary {
 public:
  explicit CpuDiary(const Processor& processor) : processor_(processor) {}

  /// Sets the observer. Activities that have not yet been reported are dropped.
  void set_observer(Observer* observer) {
    observer_ = observer;
    spans_.clear();
  }
  bool has_observer() const { return observer_; }
  /// The observer's id for the name of a process; 0 if there is no observer.
  std::uint32_t number_of(const std::string& name);
  void note(const Process& process, Observer::Doing doing, Seconds from, Seconds to);
  void tell_past(Seconds now);  ///< reports the activities that have ended
  void stretch(const Stretch& stretch);
  void flush(Seconds now);

  struct Span {
    std::uint32_t process;
    Observer::Doing doing;
    Seconds from, to;
  };
  /// The unreported activities that have begun; those that have not ended are cut at `now`.
  std::vector<Span> untold(Seconds now) const;

 private:
  Observer* observer_ = nullptr;
  const Processor& processor_;
  std::vector<Span> spans_;  // activities not reported yet
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

class Cpu {
 public:
  Cpu(Engine& engine, const Model& model, Processor& processor)
      : engine_(engine), model_(model), processor_(processor), diary_(processor) {}

  /// Puts a blocked process on its ready queue at the date `at`. This date is the present one, or
  /// the own time (see Process) of a process that is running on this CPU.
  void make_ready(Process& process, Seconds at);
  /// Stops the CPU for ever. Its processes stay in their present state. Cycles that they have been
  /// charged but have not yet used are not executed.
  void stop();
  bool stopped() const { return stopped_at_ < NEVER; }
  Seconds lived_until() const { return std::min(engine_.now(), stopped_at_); }
  /// True if a high-priority process or a context switch occupies the CPU beyond the present date.
  bool is_ahead() const { return high_.until > now() || (is_coming_back() && low_.since > now()); }
  /// True if this low-priority process still owes cycles, and a high-priority process has become
  /// ready while its body was executing.
  bool is_interrupted(const Process& process) const { return interrupted_ == &process; }

  /// Duration of `cycles` at the CPU's present speed. DMA of links reduces this speed.
  Seconds duration(Cycles cycles) const {
    const Seconds alone = cycles / model_.cpu.clock;
    return speed_ == 1 ? alone : Seconds{alone.value / speed_};
  }
  /// Sets the fraction of the CPU's cycles taken by one `thief`. Thieves 0 to 3 are the DMA of the
  /// link at that port, 4 (BY_COMPANION) is the companion's CPU, and higher numbers are the DMA of
  /// the companion's links. Changes the end of the present computation, and of work that a
  /// high-priority process was charged before it blocked.
  static constexpr std::size_t BY_COMPANION = 4;
  void set_stolen(std::size_t thief, double share);
  CpuUse use() const { return use_by(now()); }  ///< use up to the present date
  /// Use up to a date in the future, if no event occurs before that date.
  CpuUse use_by(Seconds date) const;
  /// Lower bound on the time until a process ends its present computation. Assumes that it gets the
  /// CPU at once and at full speed.
  Seconds least_left(const Process& process) const;
  /// Number of processes in the two ready queues.
  std::size_t ready() const { return high_queue_.size() + low_queue_.size(); }

  void set_observer(Observer* observer) { diary_.set_observer(observer); }
  void name_for_observer(Process& process);
  void flush_observer();
  /// The activities up to the present date that have not yet been reported to the observer.
  std::vector<CpuDiary::Span> untold() const;

 private:
  static constexpr Seconds NEVER{std::numeric_limits<double>::infinity()};

  using ReadyQueue = boost::intrusive::list<
      Process, boost::intrusive::member_hook<Process, Process::ReadyHook, &Process::ready_hook_>>;

  // State of the high-priority process that occupies the CPU.
  struct High {
    // True while the process waits for its charged cycles to pass. The end of this wait depends on
    // the CPU's speed.
    bool computing = false;
    bool preempting = false;  // its next computation includes a switch from low priority
    std::uint64_t id = 0;     // pending events with another number have no effect
    Seconds until{};          // use_ already counts high-priority time up to this date
  };
  // State of the low-priority process that is computing or interrupted.
  struct Low {
    bool computing = false;  // false while its body executes on the host
    Seconds since{};         // start of its computation; ahead of the clock during a switch back
    Seconds end{};           // end of its computation if nothing interferes
    Seconds left{};          // computation still to be done, at full speed, while interrupted
    // Start of a switch back to this process that is not yet counted in use_.
    Seconds way_back_from = NEVER;
    Seconds slice_end{};           // end of the process's time slice
    Seconds gives_way_at = NEVER;  // tick at which it yields to another ready low-priority process
  };
  struct Timer {
    bool armed = false;
    std::uint64_t rank = Process::NO_RANK;
    Seconds at{};
    std::uint64_t id = 0;  // timers with another number have no effect
  };

  Seconds now() const { return engine_.now(); }
  void dispatch_when_free();  // schedules dispatch() at free_at_
  void ask_dispatch();
  void dispatch();
  // Runs the process's body until the process needs time, blocks or ends.
  void execute(Process& process);
  void account_high(const Process& process, Seconds time);
  void release(Process& process, Seconds free_at);  // called when the process has blocked or ended
  void end_high_at(Seconds date);
  void preempt(Process& high);
  void stop_low();
  void resume_interrupted();
  void foresee_way_back();
  void stay_away();
  bool is_coming_back() const { return low_.way_back_from < NEVER; }
  Seconds switched_back(Seconds date) const;
  double slices(Seconds date) const;
  Seconds tick_of_slices(double tick) const;
  void begin_slice(Process& low);
  void compute(Process& low, Seconds time);  // starts a computation that can be pre-empted
  void stretch(const Stretch& stretch);
  void at(Seconds date, const Process& process, auto then);
  void find_end_of_slice();
  void arm_low_timer();
  void low_timer();
  void account_low();  // adds the computation since low_.since to use_
  Seconds high_after(Seconds date) const;
  Seconds low_before(Seconds date) const;
  Seconds busy_by(Seconds date) const;
  Seconds stolen_idle(Seconds date) const;

  // Members used each time a process starts to run come first, so that they share cache lines.
  Engine& engine_;
  const Model& model_;
  Processor& processor_;
  Process* running_ = nullptr;  // the process that occupies the CPU; null if the CPU is idle
  // The low-priority process that was pre-empted; null if there is none.
  Process* interrupted_ = nullptr;
  ReadyQueue high_queue_, low_queue_;
  Seconds free_at_{};  // date at which the last high-priority process leaves the CPU
  double speed_ = 1;   // fraction of cycles left by DMA and a companion
  Seconds speed_since_{}, busy_then_{};
  Seconds stopped_at_ = NEVER;
  bool dispatching_ = false;       // a call of dispatch() is scheduled
  std::uint64_t dispatch_id_ = 0;  // scheduled calls with another number have no effect
  // The process that leaves the CPU at free_at_, if that is ahead of the clock.
  Process* last_high_ = nullptr;
  // True while the CPU executes the body of a process that has just reached a link. The next
  // process may start only after all other processes that reach links at this date.
  bool has_come_to_link_ = false;
  High high_;
  CpuUse use_;
  CpuDiary diary_;
  Low low_;
  Timer low_timer_;
  std::array<double, 2 * BY_COMPANION + 1> stolen_{};
};

}  // namespace machine

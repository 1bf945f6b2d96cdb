#pragma once
// A transputer's CPU: the microcoded two-priority scheduler.
//
// High-priority processes run until they block. Low-priority processes run when no high one can,
// and high ones pre-empt them. They share the CPU in time slices: a low process gives way after one
// to two slice periods if another low process is ready. (INMOS T800 family; transputer data book.)
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

/// Receives what processors and links of a running machine did, after each span has ended.
struct Observer {
  enum class Doing : std::uint8_t { high, low, switching };

  virtual ~Observer() = default;
  /// Names a process; processes of one name on one processor share an id, dense from 0.
  virtual void name_process(const Processor& on, std::uint32_t id, const std::string& name) = 0;
  virtual void ran(const Processor& on, std::uint32_t id, Doing doing, Seconds from,
                   Seconds to) = 0;
  virtual void moved(const LinkDirection& link, const std::string& channel, std::uint64_t bytes,
                     Seconds from, Seconds to) = 0;
};

struct CpuUse {
  Seconds busy_high{}, busy_low{};  ///< executing, by priority; switches count as high
  /// Cycles that DMA and a companion took from the idle CPU. A busy CPU stays busy longer instead.
  Seconds stolen_idle{};
  std::uint64_t preemptions = 0, dispatches = 0;
  Seconds busy() const { return busy_high + busy_low; }
  /// All that a further process of lowest priority would not get, apart from switches.
  Seconds taken() const { return busy() + stolen_idle; }
};

/// A CPU's spans for its observer. DMA may still change a span ahead of the clock, so each is
/// passed on when it has ended, or by flush().
class CpuDiary {
 public:
  explicit CpuDiary(const Processor& processor) : processor_(processor) {}

  /// Drops the spans that were not passed on.
  void set_observer(Observer* observer) {
    observer_ = observer;
    spans_.clear();
  }
  bool has_observer() const { return observer_; }
  /// The number of a process's name, see Observer; 0 without an observer.
  std::uint32_t number_of(const std::string& name);
  void note(const Process& process, Observer::Doing doing, Seconds from, Seconds to);
  void tell_past(Seconds now);  ///< passes on the spans that have ended
  void stretch(const Stretch& stretch);
  void flush(Seconds now);

  struct Span {
    std::uint32_t process;
    Observer::Doing doing;
    Seconds from, to;
  };
  /// The begun spans that were not passed on.
  std::vector<Span> untold(Seconds now) const;

 private:
  Observer* observer_ = nullptr;
  const Processor& processor_;
  std::vector<Span> spans_;  // not passed on yet
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

class Cpu {
 public:
  Cpu(Engine& engine, const Model& model, Processor& processor)
      : engine_(engine), model_(model), processor_(processor), diary_(processor) {}

  /// Puts a blocked process on its ready queue at time `at`: now or, from a running process of this
  /// CPU, that process's own time.
  void make_ready(Process& process, Seconds at);
  /// From now on no process runs: they stay where they are, and what was charged ahead is not
  /// executed.
  void stop();
  bool stopped() const { return stopped_at_ < NEVER; }
  Seconds lived_until() const { return std::min(engine_.now(), stopped_at_); }
  /// Returns true if the CPU is already taken beyond the clock, by a process's own time.
  bool is_ahead() const { return high_.until > now() || (is_coming_back() && low_.since > now()); }
  /// Returns true if a high-priority process has become ready while this low one executes and owes
  /// cycles.
  bool is_interrupted(const Process& process) const { return interrupted_ == &process; }

  /// How long the CPU takes for `cycles` now, with what the links' DMA steals from it.
  Seconds duration(Cycles cycles) const {
    const Seconds alone = cycles / model_.cpu.clock;
    return speed_ == 1 ? alone : Seconds{alone.value / speed_};
  }
  /// From now on `thief` takes this share of the CPU's cycles. It is a link's DMA by its port (0 to
  /// 3), BY_COMPANION, or the DMA of a companion's link after it. Work under way ends later, and so
  /// does work that a high-priority process charged before it blocked.
  static constexpr std::size_t BY_COMPANION = 4;
  void set_stolen(std::size_t thief, double share);
  CpuUse use() const { return use_by(now()); }  ///< up to now
  /// The same up to a later date, if nothing happens until then.
  CpuUse use_by(Seconds date) const;
  /// How long a process that computes, or waits for the CPU in the middle of that, still takes at
  /// least: at full speed.
  Seconds least_left(const Process& process) const;
  std::size_t ready() const { return high_queue_.size() + low_queue_.size(); }  ///< processes

  void set_observer(Observer* observer) { diary_.set_observer(observer); }
  void name_for_observer(Process& process);
  void flush_observer();
  /// The spans up to now that the observer has not received.
  std::vector<CpuDiary::Span> untold() const;

 private:
  static constexpr Seconds NEVER{std::numeric_limits<double>::infinity()};

  using ReadyQueue = boost::intrusive::list<
      Process, boost::intrusive::member_hook<Process, Process::ReadyHook, &Process::ready_hook_>>;

  // The high-priority process that has the CPU.
  struct High {
    bool computing = false;   // it has synced: its end moves with the speed
    bool preempting = false;  // its next charge begins with a switch
    std::uint64_t id = 0;     // ends with another id are stale
    Seconds until{};          // up to when use_ already counts high-priority time
  };
  // The low-priority process that is computing or interrupted.
  struct Low {
    bool computing = false;  // else it executes
    Seconds since{};         // it has had the CPU since then; ahead of the clock on a way back
    Seconds end{};           // its computation ends then if nobody interferes any more
    Seconds left{};          // computation left while it is interrupted, at full speed
    Seconds way_back_from = NEVER;  // start of a switch back that use_ does not count yet
    Seconds slice_end{};            // from then on it gives way to another low process,
    Seconds gives_way_at = NEVER;   // at this tick, once there is one
  };
  struct Timer {
    bool armed = false;
    std::uint64_t rank = Process::NO_RANK;
    Seconds at{};
    std::uint64_t id = 0;  // timers with another id are stale
  };

  Seconds now() const { return engine_.now(); }
  void dispatch_when_free();  // from free_at_ on: see who runs next
  void ask_dispatch();
  void dispatch();
  void execute(Process& process);  // let it run until it needs time, blocks or ends
  void account_high(const Process& process, Seconds time);
  void release(Process& process, Seconds free_at);  // it blocked or ended
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
  void compute(Process& low, Seconds time);  // a low process spends time, pre-emptably
  void stretch(const Stretch& stretch);
  void at(Seconds date, const Process& process, auto then);
  void find_end_of_slice();
  void arm_low_timer();
  void low_timer();
  void account_low();  // what the low process has computed since low_.since
  Seconds high_after(Seconds date) const;
  Seconds low_before(Seconds date) const;
  Seconds busy_by(Seconds date) const;
  Seconds stolen_idle(Seconds date) const;

  // Members used at every dispatch come first, so that they share cache lines.
  Engine& engine_;
  const Model& model_;
  Processor& processor_;
  Process* running_ = nullptr;      // has the CPU; null when idle
  Process* interrupted_ = nullptr;  // the low process that lost it to a high one
  ReadyQueue high_queue_, low_queue_;
  Seconds free_at_{};  // when the last high-priority process gave it up
  double speed_ = 1;   // share of the cycles that the links' DMA and a companion leave
  Seconds speed_since_{}, busy_then_{};
  Seconds stopped_at_ = NEVER;
  bool dispatching_ = false;       // dispatch() is due
  std::uint64_t dispatch_id_ = 0;  // those with another id are stale
  Process* last_high_ = nullptr;   // blocks from free_at_ on, where that is ahead of the clock
  // The process that executes has just paid for coming to a link: the CPU goes to the next one
  // after all others that come to links at this date.
  bool has_come_to_link_ = false;
  High high_;
  CpuUse use_;
  CpuDiary diary_;
  Low low_;
  Timer low_timer_;
  std::array<double, 2 * BY_COMPANION + 1> stolen_{};
};

}  // namespace machine

#pragma once
// A transputer's CPU: the microcoded two-priority scheduler, and the memory of one processor.
//
// High-priority processes run until they block. Low-priority ones run when no high one can, are
// pre-empted by them, and share the CPU in time slices: a low process gives way after one to two
// slice periods if another low process is ready. (INMOS T800 family; transputer data book.)
#include <algorithm>
#include <array>
#include <deque>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "simulator/machine/engine.hpp"
#include "simulator/machine/memory.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/machine/observer.hpp"
#include "simulator/machine/process.hpp"

namespace machine {

struct CpuUse {
  Seconds busy_high{}, busy_low{};  // executing, by priority; switches count as high
  std::uint64_t preemptions = 0, dispatches = 0;
  Seconds busy() const { return busy_high + busy_low; }
};

class Processor {
 public:
  // `software_factor` multiplies the cycles of occam's channel instructions, see occam::charge.
  Processor(Engine& engine, const Model& model, int id, std::string name, std::uint64_t memory,
            double software_factor);

  // A new process, ready at once. The reference stays valid as long as the processor.
  Process& start(std::string name, Priority priority, Process::Body body);
  // Forgets a process that has ended.
  void remove(const Process& process);
  // Puts a blocked process on its ready queue at time `at` (now or, from a running process of this
  // processor, that process's own time).
  void make_ready(Process& process, Seconds at);

  // The same at a date to come, if the process is in its wait number `wait` then; not if `unless`
  // has become true.
  void wake_at(Seconds date, Process& process, std::uint64_t wait, const bool* unless = nullptr);

  // From now on no process runs here: they stay where they are, and what was charged ahead is not
  // executed. Its links are to be cut too, see Machine::stop_processor.
  void stop();
  bool stopped() const { return stopped_at_ < NEVER; }
  Seconds lived_until() const { return std::min(now(), stopped_at_); }
  // Whether the CPU is taken up to a date to come: a process's own time may be ahead.
  bool is_ahead() const { return high_until_ > now(); }

  int id() const { return id_; }
  const std::string& name() const { return name_; }
  const Model& model() const { return model_; }
  Hertz clock() const { return model_.cpu.clock; }
  double software_factor() const { return software_factor_; }
  // How long the CPU takes for `cycles` now, with what the links' DMA steals from it.
  Seconds duration(Cycles cycles) const { return {(cycles / clock()).value / speed_}; }
  Seconds now() const { return engine_.now(); }
  Engine& engine() { return engine_; }
  Memory& memory() { return memory_; }
  CpuUse use() const;  // up to now
  const std::vector<std::unique_ptr<Process>>& processes() const { return processes_; }

  // Of a low-priority process that is executing: whether a high one has become ready meanwhile.
  bool has_lost_cpu(const Process& process) const { return interrupted_ == &process; }
  // From now on the DMA of link `port` (0 to 3) takes this share of the CPU's cycles: whatever is
  // being computed ends later. (What a high-priority process charged just before it blocked is
  // certain already: see Process::sync_if_long.)
  void set_stolen(std::size_t port, double share);
  // Tells what the processes do, from now on; a null pointer: nobody.
  void set_observer(Observer* observer);
  void flush_observer();  // what is not over, up to now
  // Ends the simulation with this exception (thrown again by Machine::run).
  void fail(std::exception_ptr failure);
  std::exception_ptr failure() const { return failure_; }

 private:
  static constexpr Seconds NEVER{std::numeric_limits<double>::infinity()};
  void dispatch_at(Seconds date);  // the CPU is free from then on: see who runs next
  void dispatch();
  void execute(Process& process);  // let it run until it needs time, blocks or ends
  void release(Process& process, Seconds free_at);  // it blocked or ended
  void preempt(Process& high);
  void resume_interrupted();
  double slices(Seconds date) const;
  Seconds tick_of_slices(double tick) const;
  void begin_slice(Process& low);
  void compute(Process& low, Seconds time);  // a low process spends time, pre-emptably
  void end_high_at(Seconds date);
  void arm_low_timer();
  void low_timer();
  void account_low();  // what the low process has computed since low_since_
  void tell(const Process& process, Observer::Doing doing, Seconds from, Seconds to);
  void name_for_observer(Process& process);

  Engine& engine_;
  const Model& model_;
  int id_;
  std::string name_;
  Memory memory_;
  double software_factor_;
  double speed_ = 1;  // share of the cycles that the links' DMA leaves
  std::array<double, 4> stolen_{};
  std::vector<std::unique_ptr<Process>> processes_;
  std::vector<std::unique_ptr<Process>> removed_;  // that a wake_at still refers to
  std::size_t sweep_at_ = 16;                      // how many of them there may be
  std::deque<Process*> high_, low_;
  Process* running_ = nullptr;      // who has the CPU; null when idle
  Process* interrupted_ = nullptr;  // the low process that lost it to a high one
  Seconds free_at_{};               // when the last high-priority process gave it up
  bool dispatching_ = false;        // dispatch() is due

  // Of the low process that is computing or interrupted.
  bool low_computing_ = false;    // else it executes an operation
  Seconds low_since_{};           // since when it has had the CPU; ahead of the clock on a way back
  Seconds low_end_{};             // when its computation ends if nobody interferes any more
  Seconds low_left_{};            // what is left of it while it is interrupted, at full speed
  Seconds slice_end_{};           // from when on it gives way to another low process,
  Seconds gives_way_at_ = NEVER;  // at this tick, once there is one
  bool timer_armed_ = false;
  Seconds timer_at_{};
  std::uint64_t timer_id_ = 0;  // timers with another id are stale

  Observer* observer_ = nullptr;
  struct Span {
    std::uint32_t id;
    Observer::Doing doing;
    Seconds from, to;
  };
  std::deque<Span> ahead_;  // that may not be over yet: told with the next, or by flush_observer()
  std::map<std::string, std::uint32_t, std::less<>> trace_ids_;
  bool preempting_ = false;        // the next charge of the high process begins with a switch
  Seconds way_back_from_ = NEVER;  // of the low process that is computing, not told yet

  CpuUse use_;
  bool high_computing_ = false;  // a high process has synced: its end moves with the speed
  std::uint64_t high_id_ = 0;    // ends with another id are stale
  Seconds high_until_{};         // up to when use_ already counts high-priority time
  std::exception_ptr failure_;
  Seconds stopped_at_ = NEVER;
};

}  // namespace machine

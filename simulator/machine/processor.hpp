#pragma once
// A transputer's CPU: the microcoded two-priority scheduler, and the memory of one processor.
//
// High-priority processes run until they block. Low-priority ones run when no high one can, are
// pre-empted by them, and share the CPU in time slices: a low process gives way after one to two
// slice periods if another low process is ready. (INMOS T800 family; transputer data book.)
#include <deque>
#include <exception>
#include <memory>
#include <vector>

#include "simulator/machine/engine.hpp"
#include "simulator/machine/memory.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/machine/process.hpp"

namespace machine {

struct CpuUse {
  Seconds busy_high{}, busy_low{};  // executing, by priority; switches count as high
  std::uint64_t preemptions = 0, dispatches = 0;
  Seconds busy() const { return busy_high + busy_low; }
};

class Processor {
 public:
  Processor(Engine& engine, const Model& model, int id, std::string name, std::uint64_t memory);

  // A new process, ready at once. The reference stays valid as long as the processor.
  Process& start(std::string name, Priority priority, Process::Body body);
  // Puts a blocked process on its ready queue at time `at` (now or, from a running process of this
  // processor, that process's own time).
  void make_ready(Process& process, Seconds at);

  int id() const { return id_; }
  const std::string& name() const { return name_; }
  const Model& model() const { return model_; }
  Hertz clock() const { return model_.cpu.clock; }
  Seconds now() const { return engine_.now(); }
  Engine& engine() { return engine_; }
  Memory& memory() { return memory_; }
  CpuUse use() const;  // up to now
  const std::vector<std::unique_ptr<Process>>& processes() const { return processes_; }

  // Of a low-priority process that is executing: whether a high one has become ready meanwhile.
  bool has_lost_cpu(const Process& process) const { return interrupted_ == &process; }
  // Ends the simulation with this exception (thrown again by Machine::run).
  void fail(std::exception_ptr failure);
  std::exception_ptr failure() const { return failure_; }

 private:
  void dispatch_at(Seconds date);  // the CPU is free from then on: see who runs next
  void dispatch();
  void execute(Process& process);  // let it run until it needs time, blocks or ends
  void release(Process& process, Seconds free_at);  // it blocked or ended
  void preempt(Process& high);
  void resume_interrupted();
  void begin_slice(Process& low);
  void compute(Process& low, Seconds time);  // a low process spends time, pre-emptably
  void arm_low_timer();
  void low_timer();

  Engine& engine_;
  const Model& model_;
  int id_;
  std::string name_;
  Memory memory_;
  std::vector<std::unique_ptr<Process>> processes_;
  std::deque<Process*> high_, low_;
  Process* running_ = nullptr;      // who has the CPU; null when idle
  Process* interrupted_ = nullptr;  // the low process that lost it to a high one
  Seconds free_at_{};               // when the last high-priority process gave it up
  bool dispatching_ = false;        // dispatch() is due

  // Of the low process that is computing or interrupted.
  bool low_computing_ = false;  // else it executes an operation
  Seconds low_since_{};         // since when it has had the CPU; ahead of the clock on a way back
  Seconds low_end_{};           // when its computation ends if nobody interferes any more
  Seconds low_left_{};          // what is left of it while it is interrupted
  Seconds slice_end_{};         // from when on it gives way to another low process
  bool timer_armed_ = false;
  Seconds timer_at_{};
  std::uint64_t timer_id_ = 0;  // timers with another id are stale

  CpuUse use_;
  Seconds high_until_{};  // up to when use_ already counts high-priority time
  std::exception_ptr failure_;
};

}  // namespace machine

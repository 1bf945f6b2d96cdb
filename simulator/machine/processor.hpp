#pragma once
// A processor: a CPU, its memory, and the processes on it. Two processors that share one memory are
// companions of each other.
#include <concepts>
#include <exception>
#include <memory>
#include <vector>

#include "simulator/machine/cpu.hpp"
#include "simulator/machine/faults.hpp"

namespace machine {

/// How the costs of a program's instructions are computed.
enum class Code : std::uint8_t {
  bare,  ///< times from the data sheet
  /// Times multiplied by model.software.occam_factor, because compiled code executes more
  /// instructions. Copies, divisions and durations are not multiplied.
  compiled,
};

/// Memory of a processor: its size, and the number of bytes that the program has allocated.
class Memory {
 public:
  /// `size` is in bytes; `owner` is the processor's name in error messages.
  Memory(std::string owner, std::uint64_t size) : owner_(std::move(owner)), size_(size) {}

  /// Throws OutOfMemory if fewer than `bytes` are available. `what` names the data in the message,
  /// and `when` is the date.
  void allocate(std::uint64_t bytes, const std::string& what, Seconds when) {
    if (bytes > left())
      throw OutOfMemory(
          owner_, when,
          fmt::format(
              "{} is out of memory at {:.6f} s: {} asked for {} bytes, {} of {} are available",
              owner_, when.value, what, bytes, left(), size_));
    used_ += bytes;
    peak_ = std::max(peak_, used_);
  }
  void release(std::uint64_t bytes) { used_ -= bytes; }

  std::uint64_t size() const { return size_; }
  std::uint64_t used() const { return used_; }
  std::uint64_t left() const { return size_ - used_; }
  std::uint64_t peak() const { return peak_; }

 private:
  std::string owner_;
  std::uint64_t size_, used_ = 0, peak_ = 0;
};

class Processor {
 public:
  /// `role` is the purpose of the processor in the program and may be empty.
  Processor(Engine& engine, std::shared_ptr<const Model> model, int id, std::string name,
            std::shared_ptr<Memory> memory, std::string role, Code code);

  /// Starts a process, which is ready at once. The reference is valid until the process is removed.
  Process& start(std::string name, Priority priority, Process::Body body);
  Process& start(std::string name, Priority priority, Proc proc);
  /// Refuses a function that returns a Proc: the caller must pass the Proc itself.
  template <class Maker>
  requires std::same_as<std::invoke_result_t<Maker&>, Proc> Process& start(std::string name,
                                                                           Priority priority,
                                                                           Maker maker) = delete;
  /// Removes a process that has ended.
  void remove(const Process& process);
  /// Makes a blocked process ready, see Cpu::make_ready.
  void make_ready(Process& process, Seconds at) { cpu_.make_ready(process, at); }
  /// Makes the process ready at a future date, if it is then still in the wait with number `wait`
  /// (see Process::waits).
  void wake_at(Seconds date, Process& process, std::uint64_t wait);
  /// Does the same as wake_at(), but before all other events of `date`.
  void wake_first_at(Seconds date, Process& process, std::uint64_t wait);

  /// Makes the id of the next process, which is unique within a machine.
  ProcessId make_id() { return (static_cast<ProcessId>(id_) + 1) << 32 | ++made_; }

  int id() const { return id_; }
  const std::string& name() const { return name_; }
  const std::string& role() const { return role_; }
  const Model& model() const { return *model_; }
  std::shared_ptr<const Model> share_model() const { return model_; }
  Hertz clock() const { return model_->cpu.clock; }
  /// Factor on the cycles of occam's channel instructions, see occam::charge.
  double software_factor() const { return software_factor_; }
  Seconds duration(Cycles cycles) const { return cpu_.duration(cycles); }
  Seconds now() const { return engine_.now(); }
  Engine& engine() { return engine_; }
  Cpu& cpu() { return cpu_; }
  const Cpu& cpu() const { return cpu_; }
  CpuUse use() const { return cpu_.use(); }  ///< use up to now
  bool stopped() const { return cpu_.stopped(); }
  Memory& memory() { return *memory_; }
  const Memory& memory() const { return *memory_; }
  std::shared_ptr<Memory> share_memory() const { return memory_; }
  /// The other processor on the same memory; null if there is none.
  Processor* companion() const { return companion_; }
  const std::vector<std::unique_ptr<Process>>& processes() const { return processes_; }

  /// Makes this processor and `companion` share one memory, see Machine::add_companion.
  void join(Processor& companion);
  /// Sets the fraction of memory cycles that the DMA of the link at `port` (0 to 3) takes. The
  /// companion's CPU loses these cycles too.
  void set_stolen(std::size_t port, double share);

  /// Sets the observer of the CPU.
  void set_observer(Observer* observer);
  /// Ends the simulation. Machine::run will rethrow the exception.
  void fail(std::exception_ptr failure);
  const std::exception_ptr& failure() const { return failure_; }
  Seconds failed_at() const { return failed_at_; }

 private:
  Process& start(std::unique_ptr<Process> process);
  void wake(Process& process, std::uint64_t wait);

  Engine& engine_;
  std::shared_ptr<const Model> model_;
  double software_factor_;
  int id_;
  std::uint32_t made_ = 0;  // number of processes made
  Processor* companion_ = nullptr;
  std::exception_ptr failure_;
  Seconds failed_at_{};
  Cpu cpu_;
  std::string name_, role_;
  std::shared_ptr<Memory> memory_;
  std::vector<std::unique_ptr<Process>> processes_;
  // Removed processes, kept while an event of wake_at() may refer to them.
  std::vector<std::unique_ptr<Process>> removed_;
  // Size of removed_ at which processes without pending events are deleted.
  std::size_t sweep_at_ = 16;
};

inline bool Process::must_sync() const {
  return debt_.value > 0 || processor_.cpu().is_interrupted(*this);
}

inline Seconds Process::own_time() const {
  const Seconds clock = processor_.now();
  return debt_.value == 0 ? clock : clock + processor_.duration(debt_);
}

}  // namespace machine

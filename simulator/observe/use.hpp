#pragma once
// How much processors, link directions and processes were used during a period.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "simulator/machine/machine.hpp"

namespace observe {

struct CpuRow {
  std::string name, role;  ///< name and purpose, see machine::Processor
  /// Busy_high_s: time in high-priority processes and in context switches.
  double busy_s = 0, busy_high_s = 0;
  std::uint64_t preemptions = 0, dispatches = 0;
  std::uint64_t memory_peak_bytes = 0;
  std::string model;                   ///< name of the model
  std::optional<std::uint64_t> tasks;  ///< number of tasks done, if the program counts them
};

struct LinkRow {
  std::string from, to;
  std::size_t beside = 0;  ///< number of earlier links between the same two processors
  double busy_s = 0;
  std::uint64_t messages = 0, bytes = 0;
};

/// Waiting times of a process. In the remaining time the process executed or was ready.
struct ProcessRow {
  machine::ProcessId id = 0;
  std::string name;  ///< names need not be unique
  /// Time blocked in outputs, inputs and ALTs.
  double output_s = 0, input_s = 0, alternative_s = 0;
};

struct Use {
  double time_s = 0;
  std::vector<CpuRow> cpus;
  std::vector<LinkRow> links;  ///< two rows per link, one for each direction
  std::vector<ProcessRow> processes;
};

/// Calls of a kernel: host time, and cycles as counted and as charged. Only if costs are host
/// times.
struct KernelUse {
  std::string name;
  std::uint64_t calls = 0;
  double host_s = 0;  ///< host time of all calls
  machine::Cycles counted{}, charged{};
  double longest_batch_s = 0;  ///< host time of the longest batch of calls in s
  bool is_short = false;       ///< true if even the longest batch was too short for the clock
};

/// Use from the machine's start to the present date. Throws base::InvariantBroken if a resource
/// would have been busy for longer than this period.
Use collect(const machine::Machine& machine);
/// Use during the period from `before` to `after`.
Use between(const Use& before, const Use& after);

/// Name of the link direction: "p0>p1", or "p0>p1 (2)" for the second link between two processors.
std::string name_of(const LinkRow& link);
/// Throws base::InvariantBroken for an unknown process.
const ProcessRow& find_process(const Use& use, machine::ProcessId id);
std::uint64_t total_messages(const Use& use);
std::uint64_t total_bytes(const Use& use);

/// The columns messages_sent and bytes_sent.
base::Columns<Use> message_columns();
/// The column link_busy_max.
base::Column<Use> link_busy_column();

}  // namespace observe

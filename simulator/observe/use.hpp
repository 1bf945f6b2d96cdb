#pragma once
// How busy every processor and link direction has been, between two instants.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "simulator/machine/machine.hpp"

namespace observe {

struct CpuRow {
  std::string name, role;              ///< as machine::Processor has them
  double busy_s = 0, busy_high_s = 0;  ///< high: processes of high priority, and switches
  std::uint64_t preemptions = 0, dispatches = 0;
  std::uint64_t memory_peak_bytes = 0;
  std::string model;                   ///< its name
  std::optional<std::uint64_t> tasks;  ///< that it has done; none where they are not counted
};

struct LinkRow {
  std::string from, to;
  std::size_t beside = 0;  ///< links before it that join the same two
  double busy_s = 0;
  std::uint64_t messages = 0, bytes = 0;
};

/// What a process waited for. The rest of the time it was executing, or ready to.
struct ProcessRow {
  machine::ProcessId id = 0;
  std::string name;  ///< "coordinator.coordination"; several may have one
  double output_s = 0, input_s = 0, alternative_s = 0;  ///< blocked in out, in, ALT
};

struct Use {
  double time_s = 0;
  std::vector<CpuRow> cpus;
  std::vector<LinkRow> links;  ///< two directions each
  std::vector<ProcessRow> processes;
};

/// What the calls of a kernel took on the host and were charged, where costs are timed.
struct KernelUse {
  std::string name;
  std::uint64_t calls = 0;
  double host_s = 0;  ///< of all calls
  machine::Cycles counted{}, charged{};
  double longest_batch_s = 0;  ///< calls measured at once took so long, at most
  bool is_short = false;       ///< and that was too short for the host's clock
};

/// Everything up to now. Throws base::InvariantBroken if a resource was busier than time allows.
Use collect(const machine::Machine& machine);
/// What happened from `before` to `after`.
Use between(const Use& before, const Use& after);

/// "p0>p1", of the second link between the two "p0>p1 (2)".
std::string name_of(const LinkRow& link);
/// The first processor of a role; null if there is none.
const CpuRow* find_role(const Use& use, std::string_view role);
/// Throws base::InvariantBroken for a name that is not there.
const ProcessRow& find_process(const Use& use, std::string_view name);
std::uint64_t total_messages(const Use& use);
std::uint64_t total_bytes(const Use& use);

/// The columns messages_sent and bytes_sent.
base::Columns<Use> message_columns();
/// The column link_busy_max.
base::Column<Use> link_busy_column();

}  // namespace observe

#pragma once
// A transputer model: all numbers that describe the machine and the costs of programs, with unit,
// provenance and source. The numbers come from model files, never from code. An entry may be a
// formula over other entries, so that a change of the number of wait states, for instance, also
// changes every entry that depends on it.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "simulator/machine/units.hpp"

namespace machine {

/// Kind of evidence for a number. A calibrated number was fitted to published table cells, which
/// its entry names.
enum class Provenance { datasheet, thesis, calibrated, assumed };

/// Range of plausible values for an uncertain number.
struct Range {
  double low, high;
  /// True if low and high are fractions of the entry's value, false if they have the entry's unit.
  bool is_share;
  std::string why;  ///< justification of the bounds
};

struct Entry {
  std::string key;      ///< such as "link.one_way_rate"
  double value = 0;     ///< if the entry is a formula, the formula's value
  std::string formula;  ///< formula over the keys of other entries; empty if the entry is a number
  std::string unit;     ///< such as "cycles" or "bytes/s"
  Provenance provenance = Provenance::assumed;
  std::string source;
  std::string where;  ///< place named in messages, such as "my.toml:4: link.one_way_rate"
  std::optional<Range> range = {};
  /// Formula for the quantity that the published table cells of a calibrated entry determine. The
  /// formula is linear in the entry. Empty if the cells determine the entry itself, and for entries
  /// that are not calibrated.
  std::string holds = {};
};

using NamedNumbers = std::map<std::string, double, std::less<>>;

struct Model {
  std::string name;  ///< includes the changes made by override_model()
  std::string base;  ///< name of the model without these changes
  std::vector<Entry> entries;

  struct Cpu {
    Hertz clock;
  } cpu;
  struct Memory {
    double steal_word;   // CPU cycles that a link's DMA takes for each 4-byte word
    double least_share;  // fraction of the memory cycles that DMA always leaves to the CPU
    // Fraction of its cycles that a CPU loses if a second processor shares its memory.
    double companion_share;
  } memory;
  struct Link {
    double bit_rate;                      // bits/s
    double one_way_rate, both_ways_rate;  // bytes/s, see LinkRates
    double switch_bits;       // delay of a message in each C004 link switch, in bit times
    double switch_byte_bits;  // delay of each byte in each link switch, in bit times
  } link;
  struct Scheduler {
    Cycles slice;          // time slice period
    Cycles preemption;     // switch from a low-priority process to a high-priority one
    Cycles return_to_low;  // switch back to the low-priority process
    // Instructions startp and endp: for branches of a PAR with equal priorities.
    Cycles start_process, end_process;
    Cycles run_process;            // instruction runp: for a branch of a PAR with another priority
    Cycles par_setup, par_branch;  // additional cycles of a PAR, and of each of its branches
  } scheduler;
  struct Channel {
    Cycles operands;    // loading the operands of the instructions `in` or `out`
    Cycles blocked;     // `in` or `out` if it must wait for its partner or if it starts a link
    Cycles soft_setup;  // `in` or `out` if the partner already waits on the same processor
    Cycles copy_word;   // copying a 4-byte word to or from a partner on the same processor
    Cycles out_word;    // additional cycles of the instruction `outword`, for a message of one word
    // Making a process ready on the companion, the second processor on the same memory.
    Cycles wake_companion;
    /// Minimum time from the start of `in` or `out` until the process reaches a link.
    Cycles least_to_link() const { return operands + blocked; }
  } channel;
  struct Alternative {
    Cycles setup, timer_setup, end;  // instructions alt, talt, altend
    // Instruction enbc with its operands, for a channel guard that is ready or not ready.
    Cycles enable_ready, enable_not;
    Cycles enable_skip, enable_timer;  // instructions enbs, enbt
    Cycles wait_ready, wait_not;       // instruction altwt, if a guard is ready or none is
    // Instruction taltwt, if a guard is ready or none is.
    Cycles timer_wait_ready, timer_wait_not;
    Cycles disable, disable_skip, disable_timer;  // instructions disc, diss, dist
    // Additional costs of replicated guards: a step of the replicator, for enabling a guard and
    // again for disabling it; an index modulo the number of guards; the address of the chosen
    // channel; the update of the guard that has precedence (favourite).
    Cycles replicated, modulo, taken, favourite;
  } alternative;
  struct Timer {
    Cycles read, wait_past, wait_future;  // instruction ldtimer; tin for a past or a future tick
    // Period of the clock at high and at low priority, in seconds.
    double high_tick, low_tick;
  } timer;
  struct Software {
    // Factor on the instructions of occam constructs, if code is compiled (Code::compiled).
    double occam_factor;
    Cycles turn;  // one iteration of a WHILE loop
    // Polling period of an idle application in seconds; 0 means without a delay.
    double idle_period;
  } software;
  struct Disk {
    double seek;  // seconds for each requested record
    double rate;  // bytes/s
  } disk;

  NamedNumbers instruction;  ///< Cycles by name of an instruction, such as "instruction.lend".
  /// Cycles by name of a kernel's operation, such as "operation.box_test", and a factor for each
  /// kernel.
  NamedNumbers operation, scale;
  /// Sizes in bytes of messages, records and memories, by name, such as "bytes.ray".
  NamedNumbers bytes;
};

// These functions throw BadInput for a name that the model does not contain.
std::uint64_t get_bytes(const Model& model, std::string_view name);
Cycles get_instruction(const Model& model, std::string_view name);
/// The cycles of an operation as given in the model, not multiplied by the factor of its kernel.
Cycles get_operation(const Model& model, std::string_view name);
/// Cycles of an operation in a router, or in the part of an application that handles messages.
/// Includes the factor scale.router.
Cycles get_compiled(const Model& model, std::string_view name);

/// Evaluates a formula over the model's entries. Throws BadInput with a message that starts with
/// `where`.
double eval(const Model& model, const std::string& formula, const std::string& where);

/// Loads a built-in model by name ("t805-25"), or a file by a path that ends in .toml. A file with
/// a line base = "NAME" contains only the differences from the model NAME. Throws BadInput.
Model load_model(std::string_view name);
Model parse_model(std::string_view text, std::string_view origin);
/// The value of an entry: a number, or a formula over other entries.
using EntryValue = std::variant<double, std::string>;
/// Formats the value as in a model file; a formula is put in quotes.
std::string to_text(const EntryValue& value);
/// Values that replace those of a model, by key ("link.bit_rate").
using Overrides = std::vector<std::pair<std::string, EntryValue>>;
/// Makes a model with some changed entries. A changed entry keeps its unit. Its provenance becomes
/// "assumed", and its source becomes `origin`. Throws BadInput.
Model override_model(std::string_view name, const Overrides& entries, std::string_view origin);
std::vector<std::string> builtin_models();
/// Returns the first sentence of the built-in model's file. Throws BadInput for an unknown name.
std::string describe_builtin(std::string_view name);

std::string to_text(double value);         ///< writes all digits of integers
std::string describe(const Model& model);  ///< formats a table of all entries
/// Formats a table of the entries that differ in value, formula, provenance or source.
std::string describe_difference(const Model& a, const Model& b);
std::string_view to_string(Provenance provenance);

/// Converts a kernel's numbers of operations into cycles.
class OperationCosts {
 public:
  /// Element i of `names` is the operation whose number is counts[i]; it must be an entry of the
  /// section [operation] of the model. `kernel` is an entry of the section [scale], a factor on the
  /// cycles.
  OperationCosts(const Model& model, std::string_view kernel,
                 std::span<const std::string_view> names);
  Cycles operator()(std::span<const std::uint64_t> counts) const;
  /// Replaces the costs from index `first` on by those of `other`, which must have the same
  /// operations.
  void replace_from(std::size_t first, const OperationCosts& other);

 private:
  std::vector<double> cycles_;
};

}  // namespace machine

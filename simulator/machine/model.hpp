#pragma once
// A transputer model: all numbers of the machine and of program costs, with unit, provenance and
// source. The numbers come from model files, never from code. An entry may be a formula over other
// entries. For example, changing the number of wait states changes every entry that depends on it.
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

/// Evidence for a number. A calibrated entry names the published table cells to which it was
/// fitted.
enum class Provenance { datasheet, thesis, calibrated, assumed };

/// Range of plausible values for an uncertain number.
struct Range {
  double low, high;
  /// True: low and high are fractions of the entry's value. False: they have the entry's unit.
  bool is_share;
  std::string why;  ///< justification of the bounds
};

struct Entry {
  std::string key;      ///< such as "link.one_way_rate"
  double value = 0;     ///< evaluated if the entry is a formula
  std::string formula;  ///< uses keys of other entries; empty for a number
  std::string unit;     ///< such as "cycles" or "bytes/s"
  Provenance provenance = Provenance::assumed;
  std::string source;
  std::string where;  ///< place for messages: "my.toml:4: link.one_way_rate"
  std::optional<Range> range = {};
  /// For a calibrated entry whose published cells determine another quantity: this quantity, as a
  /// formula that is linear in the entry. Empty if the cells determine the entry itself.
  std::string holds = {};
};

using NamedNumbers = std::map<std::string, double, std::less<>>;

struct Model {
  std::string name;  ///< includes the entries set by override_model
  std::string base;  ///< the name without overrides
  std::vector<Entry> entries;

  struct Cpu {
    Hertz clock;
  } cpu;
  struct Memory {
    double steal_word;       // CPU cycles taken by a link's DMA for each 4-byte word
    double least_share;      // minimum fraction of memory cycles that DMA leaves to the CPU
    double companion_share;  // fraction of its cycles that a CPU loses to a companion
  } memory;
  struct Link {
    double bit_rate;                      // bits/s
    double one_way_rate, both_ways_rate;  // bytes/s, see LinkRates
    double switch_bits;                   // delay of a message per C004 link switch, in bit times
    double switch_byte_bits;  // additional period of each byte per link switch, in bit times
  } link;
  struct Scheduler {
    Cycles slice;          // time slice period
    Cycles preemption;     // pre-emption of a low-priority process by a high-priority one
    Cycles return_to_low;  // resumption of the pre-empted process
    Cycles start_process, end_process;  // startp, endp: for branches of a PAR with equal priorities
    Cycles run_process;                 // runp: for a branch with different priority
    Cycles par_setup, par_branch;       // overhead of a PAR, and of each branch
  } scheduler;
  struct Channel {
    Cycles operands;        // loading the operands of `in` or `out`
    Cycles blocked;         // `in` or `out` that must wait or that starts a link
    Cycles soft_setup;      // `in` or `out` whose partner waits on the same processor
    Cycles copy_word;       // copying a 4-byte word to or from that partner
    Cycles out_word;        // additional cycles of `outword`, for a message of one word
    Cycles wake_companion;  // waking a process on the companion's CPU
    /// Minimum time from the start of `in` or `out` until the process reaches a link.
    Cycles least_to_link() const { return operands + blocked; }
  } channel;
  struct Alternative {
    Cycles setup, timer_setup, end;               // alt, talt, altend
    Cycles enable_ready, enable_not;              // enbc with its operands, for a channel guard
    Cycles enable_skip, enable_timer;             // enbs, enbt
    Cycles wait_ready, wait_not;                  // altwt
    Cycles timer_wait_ready, timer_wait_not;      // taltwt
    Cycles disable, disable_skip, disable_timer;  // disc, diss, dist
    // Replicated guards: replicator step per guard for enabling and for disabling, index modulo the
    // number of guards, address of the chosen channel, and update of the favourite guard.
    Cycles replicated, modulo, taken, favourite;
  } alternative;
  struct Timer {
    Cycles read, wait_past, wait_future;  // ldtimer, tin
    double high_tick, low_tick;           // in seconds
  } timer;
  struct Software {
    double occam_factor;  // factor on the instructions of occam constructs, for Code::compiled
    Cycles turn;          // one iteration of a WHILE loop
    double idle_period;   // polling period of an idle application in seconds; 0 for no delay
  } software;
  struct Disk {
    double seek;  // seconds per requested record
    double rate;  // bytes/s
  } disk;

  NamedNumbers instruction;  ///< Cycles of an instruction, such as "instruction.lend".
  /// Cycles of a kernel's operation, such as "operation.box_test", and a scale factor for each
  /// kernel.
  NamedNumbers operation, scale;
  /// Sizes of messages, records and memories in bytes, such as "bytes.ray".
  NamedNumbers bytes;
};

// These functions throw BadInput for a name that the model does not contain.
std::uint64_t get_bytes(const Model& model, std::string_view name);
Cycles get_instruction(const Model& model, std::string_view name);
Cycles get_operation(const Model& model, std::string_view name);  ///< without the kernel's scale
/// Cycles of an operation in a router or in an application's message handling, including
/// scale.router.
Cycles get_compiled(const Model& model, std::string_view name);

/// Evaluates a formula over the model's entries. Throws BadInput; the message starts with `where`.
double eval(const Model& model, const std::string& formula, const std::string& where);

/// Loads a built-in model ("t805-25") or a file, given as a path that ends in .toml. A file with a
/// line base = "NAME" contains only the differences from that model. Throws BadInput.
Model load_model(std::string_view name);
Model parse_model(std::string_view text, std::string_view origin);
/// The value of an entry: a number, or a formula over other entries.
using EntryValue = std::variant<double, std::string>;
/// Formats the value as a model file does, with quotes around a formula.
std::string to_text(const EntryValue& value);
/// Values that replace those of a model, by key ("link.bit_rate").
using Overrides = std::vector<std::pair<std::string, EntryValue>>;
/// Changes some entries of a model. Changed entries keep their unit, become "assumed" and get
/// `origin` as source. Throws BadInput.
Model override_model(std::string_view name, const Overrides& entries, std::string_view origin);
std::vector<std::string> builtin_models();
/// The first sentence of the model's file. Throws BadInput for an unknown name.
std::string describe_builtin(std::string_view name);

std::string to_text(double value);         ///< prints integers in full
std::string describe(const Model& model);  ///< prints a table of all entries
/// Tabulates the entries that differ in value, formula, provenance or source.
std::string describe_difference(const Model& a, const Model& b);
std::string_view to_string(Provenance provenance);

/// Converts the operation counts of a kernel into cycles.
class OperationCosts {
 public:
  /// `names[i]` is the operation counted in `counts[i]` and must be an entry of the model's
  /// [operation]. `kernel` is an entry of [scale], which multiplies the cycles.
  OperationCosts(const Model& model, std::string_view kernel,
                 std::span<const std::string_view> names);
  Cycles operator()(std::span<const std::uint64_t> counts) const;
  /// From index `first` on, replaces the costs by those of `other`, which has the same operations.
  void replace_from(std::size_t first, const OperationCosts& other);

 private:
  std::vector<double> cycles_;
};

}  // namespace machine

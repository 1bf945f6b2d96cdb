#pragma once
// A transputer model: every number of the machine and of the programs' costs, with its unit, its
// provenance and its source. The numbers live in model files, never in the code. An entry may be a
// formula over others, so that memory of one more wait state, or a workspace off chip, changes
// everything that it must.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/machine/units.hpp"

namespace machine {

/// What a number rests on. Calibrated entries name the published cells they were fitted to.
enum class Provenance { datasheet, thesis, calibrated, assumed };

/// What a number that is not known better may be.
struct Range {
  double low, high;
  bool is_share;    ///< both are shares of the entry's value, whatever that is; else in its unit
  std::string why;  ///< no narrower and no wider
};

struct Entry {
  std::string key;      ///< "link.one_way_rate"
  double value = 0;     ///< computed, if there is a formula
  std::string formula;  ///< over other entries' keys; empty for a plain number
  std::string unit;     ///< "cycles", "bytes/s", ...
  Provenance provenance = Provenance::assumed;
  std::string source;
  std::string where;  ///< "my.toml:4: link.one_way_rate"
  std::optional<Range> range = {};
  /// What the published cells of a calibrated entry fix: a formula over entries whose value is in
  /// proportion to this one. Empty where they fix the entry itself.
  std::string holds = {};
};

using NamedNumbers = std::map<std::string, double, std::less<>>;

struct Model {
  std::string name;  ///< with what override_model has set
  std::string base;  ///< without
  std::vector<Entry> entries;

  struct Cpu {
    Hertz clock;
  } cpu;
  struct Memory {
    double steal_word;       // cycles that a link's DMA takes from the CPU, for each 4-byte word
    double least_share;      // share of the memory's cycles that the CPU keeps however much moves
    double companion_share;  // share of its cycles that a CPU loses to one on the same memory
  } memory;
  struct Link {
    double bit_rate;                      // bits/s
    double one_way_rate, both_ways_rate;  // bytes/s, see LinkRates
    double switch_bits;       // delay of a C004 link switch, in bit times, each time it is passed
    double switch_byte_bits;  // what each switch adds to the period of a byte, in bit times
  } link;
  struct Scheduler {
    Cycles slice;          // a time slice period
    Cycles preemption;     // from a low-priority process to a high one that became ready
    Cycles return_to_low;  // and back
    Cycles start_process, end_process;  // startp, endp: PAR's branches of one priority
    Cycles run_process;                 // runp: a branch of another priority
    Cycles par_setup, par_branch;       // around a PAR, and around each branch it starts
  } scheduler;
  struct Channel {
    Cycles operands;        // loaded before in or out
    Cycles blocked;         // in/out that has to wait, or that starts a link
    Cycles soft_setup;      // in/out that finds its partner on this processor
    Cycles copy_word;       // and moves one 4-byte word
    Cycles out_word;        // what outword takes beyond out, for a message of one word
    Cycles wake_companion;  // to make a process of the other CPU on the memory ready
    /// The least that in or out on a link takes up to the rendezvous.
    Cycles least_to_link() const { return operands + blocked; }
  } channel;
  struct Alternative {
    Cycles setup, timer_setup, end;               // alt, talt, altend
    Cycles enable_ready, enable_not;              // a channel guard: its operands and enbc
    Cycles enable_skip, enable_timer;             // enbs, enbt
    Cycles wait_ready, wait_not;                  // altwt
    Cycles timer_wait_ready, timer_wait_not;      // taltwt
    Cycles disable, disable_skip, disable_timer;  // disc, diss, dist
    // Replicated guards: the replicator's turn for each, at either; an index taken modulo their
    // number, each time; the chosen channel's address; and the next favourite.
    Cycles replicated, modulo, taken, favourite;
  } alternative;
  struct Timer {
    Cycles read, wait_past, wait_future;  // ldtimer, tin
    double high_tick, low_tick;           // s
  } timer;
  struct Software {
    double occam_factor;  // multiplies instructions of occam's words where Code is compiled
    Cycles turn;          // of a WHILE
    double idle_period;   // s; an application without work looks for messages so often; 0: at once
  } software;
  struct Disk {
    double seek;  // s, for each record that is asked for
    double rate;  // bytes/s
  } disk;

  NamedNumbers instruction;  ///< cycles of an instruction, "instruction.lend"
  /// Cycles of a kernel's operation, "operation.box_test", times the scale of its kernel.
  NamedNumbers operation, scale;
  /// Sizes of messages, records and memories, "bytes.ray".
  NamedNumbers bytes;
};

// All throw BadInput for a name that the model does not have.
std::uint64_t get_bytes(const Model& model, std::string_view name);
Cycles get_instruction(const Model& model, std::string_view name);
Cycles get_operation(const Model& model, std::string_view name);  ///< the same; without its scale
/// An operation of routers, or of an application around its messages: times scale.router.
Cycles get_compiled(const Model& model, std::string_view name);

/// The value of a formula over the model's entries. Throws BadInput, beginning with `where`.
double eval(const Model& model, const std::string& formula, const std::string& where);

/// `name` is a built-in model ("t805-25") or a path ending in .toml. A file with a line
/// base = "NAME" holds only what differs from that model. Throws BadInput.
Model load_model(std::string_view name);
Model parse_model(std::string_view text, std::string_view origin);
/// The model with some entries set: "link.bit_rate" to a number, or to a formula in quotes, as TOML
/// spells it. They keep their unit, and are assumed by `origin`.
Model override_model(std::string_view name,
                     const std::vector<std::pair<std::string, std::string>>& entries,
                     std::string_view origin);
std::vector<std::string> builtin_models();
/// The sentence that its file begins with. Throws BadInput for an unknown name.
std::string describe_builtin(std::string_view name);

std::string to_text(double value);         ///< whole numbers in full
std::string describe(const Model& model);  ///< a table of every entry
/// A table of the entries whose value, formula, provenance or source differ.
std::string describe_difference(const Model& a, const Model& b);
std::string_view to_string(Provenance provenance);

/// Turns a kernel's counts of operations into cycles.
class OperationCosts {
 public:
  /// `names[i]` is what `counts[i]` counts. Every name must have an entry in the model's
  /// [operation]; `kernel` names the entry of [scale] that multiplies them.
  OperationCosts(const Model& model, std::string_view kernel,
                 std::span<const std::string_view> names);
  Cycles operator()(std::span<const std::uint64_t> counts) const;
  /// From the operation `first` on, takes the costs of `other`, which has the same operations.
  void replace_from(std::size_t first, const OperationCosts& other);

 private:
  std::vector<double> cycles_;
};

}  // namespace machine

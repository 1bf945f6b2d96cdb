#pragma once
// A transputer model: every number of the machine and of the programs' costs, with its unit,
// provenance and source. The numbers live in model files, never in the code. An entry may be a
// formula over other entries: a changed number of wait states, or a workspace moved off chip,
// changes every entry that depends on it.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/machine/units.hpp"

namespace machine {

/// Evidence for a number. Calibrated entries name the published table cells they were fitted to.
enum class Provenance { datasheet, thesis, calibrated, assumed };

/// Plausible range of an uncertain number.
struct Range {
  double low, high;
  bool is_share;    ///< low and high are shares of the entry's value; else they are in its unit
  std::string why;  ///< reason for these bounds
};

struct Entry {
  std::string key;      ///< "link.one_way_rate"
  double value = 0;     ///< result of the formula, if there is one
  std::string formula;  ///< over other entries' keys; empty for a plain number
  std::string unit;     ///< "cycles", "bytes/s", ...
  Provenance provenance = Provenance::assumed;
  std::string source;
  std::string where;  ///< "my.toml:4: link.one_way_rate"
  std::optional<Range> range = {};
  /// The quantity that a calibrated entry's published cells fix: a formula over entries, linear in
  /// this one. Empty if the cells fix the entry itself.
  std::string holds = {};
};

using NamedNumbers = std::map<std::string, double, std::less<>>;

struct Model {
  std::string name;  ///< including the entries set by override_model
  std::string base;  ///< the name without them
  std::vector<Entry> entries;

  struct Cpu {
    Hertz clock;
  } cpu;
  struct Memory {
    double steal_word;       // CPU cycles that a link's DMA takes for each 4-byte word
    double least_share;      // minimum share of the memory's cycles left to the CPU by the links
    double companion_share;  // share of its cycles that a CPU loses to a CPU on the same memory
  } memory;
  struct Link {
    double bit_rate;                      // bits/s
    double one_way_rate, both_ways_rate;  // bytes/s, see LinkRates
    double switch_bits;                   // delay per pass through a C004 link switch, in bit times
    double switch_byte_bits;  // increase of a byte's period by each switch, in bit times
  } link;
  struct Scheduler {
    Cycles slice;          // time slice period
    Cycles preemption;     // switch from a low-priority process to a high one that became ready
    Cycles return_to_low;  // switch back
    Cycles start_process, end_process;  // startp, endp: branches of a PAR of one priority
    Cycles run_process;                 // runp: a branch of another priority
    Cycles par_setup, par_branch;       // overhead of a PAR and of each branch it starts
  } scheduler;
  struct Channel {
    Cycles operands;        // loading the operands of in or out
    Cycles blocked;         // in/out that has to wait, or that starts a link
    Cycles soft_setup;      // in/out whose partner already waits on this processor
    Cycles copy_word;       // copy of one 4-byte word between the two
    Cycles out_word;        // extra cycles of outword over out, for a message of one word
    Cycles wake_companion;  // waking a process of the other CPU on the same memory
    /// Minimum time of in or out on a link before the rendezvous.
    Cycles least_to_link() const { return operands + blocked; }
  } channel;
  struct Alternative {
    Cycles setup, timer_setup, end;               // alt, talt, altend
    Cycles enable_ready, enable_not;              // a channel guard: its operands and enbc
    Cycles enable_skip, enable_timer;             // enbs, enbt
    Cycles wait_ready, wait_not;                  // altwt
    Cycles timer_wait_ready, timer_wait_not;      // taltwt
    Cycles disable, disable_skip, disable_timer;  // disc, diss, dist
    // Replicated guards: replicator step per guard, for enabling and for disabling; index modulo
    // the number of guards, each time; address of the chosen channel; update of the favourite.
    Cycles replicated, modulo, taken, favourite;
  } alternative;
  struct Timer {
    Cycles read, wait_past, wait_future;  // ldtimer, tin
    double high_tick, low_tick;           // s
  } timer;
  struct Software {
    double occam_factor;  // multiplies the instructions of occam constructs for Code::compiled
    Cycles turn;          // one iteration of a WHILE
    double idle_period;   // s; polling period of an application without work; 0: no delay
  } software;
  struct Disk {
    double seek;  // s per requested record
    double rate;  // bytes/s
  } disk;

  NamedNumbers instruction;  ///< cycles of an instruction, "instruction.lend"
  /// Cycles of a kernel's operation, "operation.box_test", and the scale of each kernel.
  NamedNumbers operation, scale;
  /// Sizes of messages, records and memories, "bytes.ray".
  NamedNumbers bytes;
};

// All throw BadInput for a name that the model does not have.
std::uint64_t get_bytes(const Model& model, std::string_view name);
Cycles get_instruction(const Model& model, std::string_view name);
Cycles get_operation(const Model& model, std::string_view name);  ///< without its kernel's scale
/// Operation of a router or of an application's message handling, times scale.router.
Cycles get_compiled(const Model& model, std::string_view name);

/// Value of a formula over the model's entries. Throws BadInput; the text begins with `where`.
double eval(const Model& model, const std::string& formula, const std::string& where);

/// `name` is a built-in model ("t805-25") or a path ending in .toml. A file with a line
/// base = "NAME" holds only the differences from that model. Throws BadInput.
Model load_model(std::string_view name);
Model parse_model(std::string_view text, std::string_view origin);
/// The model with some entries set: pairs of a key ("link.bit_rate") and a TOML number or quoted
/// formula. The entries keep their unit; they become "assumed", with `origin` as source.
Model override_model(std::string_view name,
                     const std::vector<std::pair<std::string, std::string>>& entries,
                     std::string_view origin);
std::vector<std::string> builtin_models();
/// First sentence of the model's file. Throws BadInput for an unknown name.
std::string describe_builtin(std::string_view name);

std::string to_text(double value);         ///< whole numbers in full
std::string describe(const Model& model);  ///< a table of every entry
/// A table of the entries whose value, formula, provenance or source differ.
std::string describe_difference(const Model& a, const Model& b);
std::string_view to_string(Provenance provenance);

/// Converts a kernel's operation counts into cycles.
class OperationCosts {
 public:
  /// `names[i]` names the operation counted in `counts[i]`; it must have an entry in the model's
  /// [operation]. `kernel` names the entry of [scale] that multiplies the cycles.
  OperationCosts(const Model& model, std::string_view kernel,
                 std::span<const std::string_view> names);
  Cycles operator()(std::span<const std::uint64_t> counts) const;
  /// Takes the costs of `other`, which has the same operations, from index `first` on.
  void replace_from(std::size_t first, const OperationCosts& other);

 private:
  std::vector<double> cycles_;
};

}  // namespace machine

#pragma once
// A transputer model: every number of the machine and of the programs' costs, with its unit, its
// provenance and its source. The numbers live in model files, never in the code.
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/machine/units.hpp"

namespace machine {

// What a number rests on. Calibrated entries name the published cells they were fitted to.
enum class Provenance { datasheet, thesis, calibrated, assumed };

struct Entry {
  std::string key;  // "link.one_way_rate"
  double value = 0;
  std::string unit;  // "cycles", "bytes/s", ...
  Provenance provenance = Provenance::assumed;
  std::string source;
};

struct Model {
  std::string name;
  std::vector<Entry> entries;

  struct Cpu {
    Hertz clock;
  } cpu;
  struct Link {
    double one_way_rate, both_ways_rate;  // bytes/s, see Engine::LinkRates
  } link;
  struct Scheduler {
    Cycles slice;          // a time slice period
    Cycles preemption;     // from a low-priority process to a high one that became ready
    Cycles return_to_low;  // and back
    Cycles start_process, end_process;
  } scheduler;
  struct Channel {
    Cycles blocked;     // in/out that has to wait, or that starts a link
    Cycles soft_setup;  // in/out that finds its partner on this processor
    Cycles copy_word;   // and moves one 4-byte word
  } channel;
  struct Alternative {
    Cycles setup, end;                // alt, altend
    Cycles enable_ready, enable_not;  // enbc, a guard
    Cycles wait_ready, wait_not;      // altwt
    Cycles disable;                   // disc, a guard
  } alternative;
  struct Timer {
    Cycles read, wait_past, wait_future;  // ldtimer, tin
    double high_tick, low_tick;           // s
  } timer;
  struct Software {
    double occam_factor;  // what compiled occam adds to the instruction times of its channels
  } software;

  // Cycles of a kernel's operation, "operation.box_test", times the scale of its kernel.
  std::map<std::string, double, std::less<>> operation;
  std::map<std::string, double, std::less<>> scale;
  // Sizes of messages, records and memories, "bytes.ray"; get_bytes throws InvalidInput on a name
  // that the model file does not have.
  std::map<std::string, double, std::less<>> bytes;
};

std::uint64_t get_bytes(const Model& model, std::string_view name);

// `name` is a built-in model ("t805-25") or a path ending in .toml. A file with a line
// base = "NAME" holds only what differs from that model. Throws InvalidInput.
Model load_model(std::string_view name);
Model parse_model(std::string_view text, std::string_view origin);
std::vector<std::string> builtin_models();
std::string to_text(double value);         // whole numbers in full
std::string describe(const Model& model);  // a table of every entry
std::string_view to_string(Provenance provenance);

// Turns a kernel's counts of operations into cycles.
class OperationCosts {
 public:
  // `names[i]` is what `counts[i]` counts. Every name must have an entry in the model's
  // [operation]; `kernel` names the entry of [scale] that multiplies them.
  OperationCosts(const Model& model, std::string_view kernel,
                 std::span<const std::string_view> names);
  Cycles operator()(std::span<const std::uint64_t> counts) const;

 private:
  std::vector<double> cycles_;
};

}  // namespace machine

#include "simulator/machine/model_fields.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/errors.hpp"

namespace machine {

namespace {

// A field of Model: the place of its value and the unit that its entry must carry.
struct Field {
  const char* key;
  const char* unit;
  std::function<void(Model&, double)> set;
};

template <class Section, class Value>
Field field(const char* key, const char* unit, Section Model::*section, Value Section::*member) {
  return {key, unit, [=](Model& model, double v) {
            Value& target = model.*section.*member;
            if constexpr (std::is_same_v<Value, Cycles>)
              target = {std::llround(v)};
            else
              target = Value{v};
          }};
}

// Entries that only other entries' formulas use.
Field shared(const char* key, const char* unit) {
  return {key, unit, [](Model&, double) {}};
}

const std::vector<Field>& fields() {
  using M = Model;
  using S = M::Scheduler;
  using C = M::Channel;
  using A = M::Alternative;
  static const std::vector<Field> all = {
      field("cpu.clock", "Hz", &M::cpu, &M::Cpu::clock),
      shared("memory.on_chip_word", "cycles"),
      shared("memory.external_cycles", "cycles"),
      shared("memory.wait_states", "cycles"),
      shared("memory.external_word", "cycles"),
      shared("memory.workspace_word", "cycles"),
      shared("memory.data_word", "cycles"),
      field("memory.steal_word", "cycles", &M::memory, &M::Memory::steal_word),
      field("memory.least_share", "1", &M::memory, &M::Memory::least_share),
      field("link.bit_rate", "bit/s", &M::link, &M::Link::bit_rate),
      field("link.byte_bits", "bits", &M::link, &M::Link::byte_bits),
      shared("link.one_way_20", "bytes/s"),
      shared("link.one_way_10", "bytes/s"),
      shared("link.one_way_5", "bytes/s"),
      shared("link.both_ways_20", "bytes/s"),
      shared("link.both_ways_10", "bytes/s"),
      shared("link.both_ways_5", "bytes/s"),
      field("link.one_way_rate", "bytes/s", &M::link, &M::Link::one_way_rate),
      field("link.both_ways_rate", "bytes/s", &M::link, &M::Link::both_ways_rate),
      field("link.switch_bits", "bits", &M::link, &M::Link::switch_bits),
      field("link.switch_byte_bits", "bits", &M::link, &M::Link::switch_byte_bits),
      field("scheduler.slice", "cycles", &M::scheduler, &S::slice),
      field("scheduler.preemption", "cycles", &M::scheduler, &S::preemption),
      field("scheduler.return_to_low", "cycles", &M::scheduler, &S::return_to_low),
      shared("scheduler.workspace_words", "1"),
      shared("scheduler.off_chip", "cycles"),
      field("scheduler.start_process", "cycles", &M::scheduler, &S::start_process),
      field("scheduler.end_process", "cycles", &M::scheduler, &S::end_process),
      field("scheduler.run_process", "cycles", &M::scheduler, &S::run_process),
      field("scheduler.par_setup", "cycles", &M::scheduler, &S::par_setup),
      field("scheduler.par_branch", "cycles", &M::scheduler, &S::par_branch),
      field("channel.operands", "cycles", &M::channel, &C::operands),
      field("channel.blocked", "cycles", &M::channel, &C::blocked),
      field("channel.soft_setup", "cycles", &M::channel, &C::soft_setup),
      field("channel.copy_word", "cycles", &M::channel, &C::copy_word),
      field("channel.out_word", "cycles", &M::channel, &C::out_word),
      field("alternative.setup", "cycles", &M::alternative, &A::setup),
      field("alternative.timer_setup", "cycles", &M::alternative, &A::timer_setup),
      field("alternative.end", "cycles", &M::alternative, &A::end),
      shared("alternative.workspace_words", "1"),
      shared("alternative.off_chip", "cycles"),
      shared("alternative.guard_operands", "cycles"),
      field("alternative.enable_ready", "cycles", &M::alternative, &A::enable_ready),
      field("alternative.enable_not", "cycles", &M::alternative, &A::enable_not),
      field("alternative.enable_skip", "cycles", &M::alternative, &A::enable_skip),
      field("alternative.enable_timer", "cycles", &M::alternative, &A::enable_timer),
      field("alternative.wait_ready", "cycles", &M::alternative, &A::wait_ready),
      field("alternative.wait_not", "cycles", &M::alternative, &A::wait_not),
      field("alternative.timer_wait_ready", "cycles", &M::alternative, &A::timer_wait_ready),
      field("alternative.timer_wait_not", "cycles", &M::alternative, &A::timer_wait_not),
      field("alternative.disable", "cycles", &M::alternative, &A::disable),
      field("alternative.disable_skip", "cycles", &M::alternative, &A::disable_skip),
      field("alternative.disable_timer", "cycles", &M::alternative, &A::disable_timer),
      field("timer.read", "cycles", &M::timer, &M::Timer::read),
      field("timer.wait_past", "cycles", &M::timer, &M::Timer::wait_past),
      field("timer.wait_future", "cycles", &M::timer, &M::Timer::wait_future),
      field("timer.high_tick", "s", &M::timer, &M::Timer::high_tick),
      field("timer.low_tick", "s", &M::timer, &M::Timer::low_tick),
      field("software.occam_factor", "1", &M::software, &M::Software::occam_factor),
      field("software.idle_period", "s", &M::software, &M::Software::idle_period),
      field("disk.seek", "s", &M::disk, &M::Disk::seek),
      field("disk.rate", "bytes/s", &M::disk, &M::Disk::rate),
  };
  return all;
}

struct OpenSection {
  std::string_view prefix;
  const char* unit;
  NamedNumbers Model::*numbers;
};
constexpr OpenSection OPEN_SECTIONS[] = {{"instruction.", "cycles", &Model::instruction},
                                         {"operation.", "cycles", &Model::operation},
                                         {"scale.", "1", &Model::scale},
                                         {"bytes.", "bytes", &Model::bytes}};

const OpenSection* find_open(std::string_view key) {
  for (const auto& open : OPEN_SECTIONS)
    if (key.starts_with(open.prefix)) return &open;
  return nullptr;
}

constexpr double LARGEST = 1e12;  // no entry is larger, in any unit

// The values that an entry may have.
struct Range {
  const char* key;
  double low, high;
};
constexpr Range RANGES[] = {
    {"cpu.clock", 1e3, LARGEST},         {"link.bit_rate", 1e3, LARGEST},
    {"link.byte_bits", 1, 1000},         {"link.one_way_rate", 1, LARGEST},
    {"link.both_ways_rate", 1, LARGEST}, {"scheduler.slice", 1, LARGEST},
    {"timer.high_tick", 1e-12, 1e3},     {"timer.low_tick", 1e-12, 1e3},
    {"memory.on_chip_word", 1, 1e6},     {"memory.workspace_word", 1, 1e6},
    {"memory.least_share", 0.001, 1},    {"memory.data_word", 1, 1e6},
    {"memory.external_word", 1, 1e6},    {"disk.rate", 1, LARGEST},
};

void check_value(const Entry& entry) {
  double low = 0, high = LARGEST;
  for (const auto& range : RANGES)
    if (entry.key == range.key) low = range.low, high = range.high;
  if (!(entry.value >= low && entry.value <= high))
    throw base::BadInput(fmt::format("{}: found {}, expected a number from {} to {}", entry.where,
                                     entry.value, low, high));
}

// A pin of the chip chooses one of three.
void check_bit_rate(const Model& model, std::string_view origin) {
  const double rate = model.link.bit_rate;
  if (rate != 5e6 && rate != 10e6 && rate != 20e6)
    throw base::BadInput(
        fmt::format("{}: link.bit_rate: found {}, expected 5e6, 10e6 or 20e6 (other links: set "
                    "link.one_way_rate and link.both_ways_rate)",
                    origin, rate));
}

}  // namespace

std::string unit_of(std::string_view key) {
  if (const auto* open = find_open(key)) return open->unit;
  const auto known = std::ranges::find(fields(), key, &Field::key);
  return known == fields().end() ? "" : known->unit;
}

bool is_open_section(std::string_view key) { return find_open(key) != nullptr; }

std::vector<std::string> field_keys() {
  std::vector<std::string> keys;
  for (const auto& field : fields()) keys.push_back(field.key);
  return keys;
}

void bind_entries(Model& model, std::string_view origin) {
  for (const auto& known : fields()) {
    const auto entry = std::ranges::find(model.entries, known.key, &Entry::key);
    if (entry == model.entries.end())
      throw base::BadInput(
          fmt::format("{}: {} is missing (unit {})", origin, known.key, known.unit));
    check_value(*entry);
    known.set(model, entry->value);
  }
  check_bit_rate(model, origin);
  for (const Entry& entry : model.entries)
    if (const auto* open = find_open(entry.key)) {
      check_value(entry);
      (model.*open->numbers)[entry.key.substr(open->prefix.size())] = entry.value;
    }
}

}  // namespace machine

// Reads model files: inherits entries from a base model, evaluates formulas, and copies the entries
// to the members of Model.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "base/fields.hpp"
#include "base/formula.hpp"
#include "base/message.hpp"
#include "base/order.hpp"
#include "base/text.hpp"
#include "base/toml.hpp"
#include "base/whole_file.hpp"
#include "simulator/machine/builtin_models.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/machine/model_entry.hpp"

namespace machine {

namespace {

constexpr std::size_t MOST_ENTRIES = 10'000;

using Field = base::Field<Model>;

template <class Section, class Value>
Field field(const char* key, const char* unit, Section Model::*section, Value Section::*member,
            double low = 0, double high = LARGEST_ENTRY) {
  const auto access = [=](auto& model) -> auto& { return model.*section.*member; };
  return base::Declare<Model>::number(key, access, low, high, unit, "");
}

// Declares an entry that is no member of Model, because only formulas of other entries use it.
Field shared(const char* key, const char* unit, double low = 0, double high = LARGEST_ENTRY) {
  return base::Declare<Model>::custom(
      key, {base::Domain::Kind::number, low, high}, unit, "",
      [](const Model&, const base::Scalar&) { return true; },
      [](const Model&) { return base::Scalar(); });
}

const std::vector<Field>& fields() {
  using M = Model;
  using S = M::Scheduler;
  using C = M::Channel;
  using A = M::Alternative;
  static const std::vector<Field> all = {
      field("cpu.clock", "Hz", &M::cpu, &M::Cpu::clock, 1e3),
      shared("memory.on_chip_word", "cycles", 1, 1e6),
      shared("memory.external_cycles", "cycles"),
      shared("memory.wait_states", "cycles"),
      shared("memory.external_word", "cycles", 1, 1e6),
      shared("memory.workspace_word", "cycles", 1, 1e6),
      shared("memory.data_word", "cycles", 1, 1e6),
      shared("memory.code_word", "cycles", 1, 1e6),
      field("memory.steal_word", "cycles", &M::memory, &M::Memory::steal_word),
      field("memory.least_share", "1", &M::memory, &M::Memory::least_share, 0.001, 1),
      field("memory.companion_share", "1", &M::memory, &M::Memory::companion_share, 0, 0.9),
      field("link.bit_rate", "bit/s", &M::link, &M::Link::bit_rate, 1e3),
      shared("link.one_way_20", "bytes/s"),
      shared("link.one_way_10", "bytes/s"),
      shared("link.one_way_5", "bytes/s"),
      shared("link.both_ways_20", "bytes/s"),
      shared("link.both_ways_10", "bytes/s"),
      shared("link.both_ways_5", "bytes/s"),
      field("link.one_way_rate", "bytes/s", &M::link, &M::Link::one_way_rate, 1),
      field("link.both_ways_rate", "bytes/s", &M::link, &M::Link::both_ways_rate, 1),
      field("link.switch_bits", "bits", &M::link, &M::Link::switch_bits),
      field("link.switch_byte_bits", "bits", &M::link, &M::Link::switch_byte_bits),
      field("scheduler.slice", "cycles", &M::scheduler, &S::slice, 1),
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
      field("channel.wake_companion", "cycles", &M::channel, &C::wake_companion),
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
      field("alternative.replicated", "cycles", &M::alternative, &A::replicated),
      field("alternative.modulo", "cycles", &M::alternative, &A::modulo),
      field("alternative.taken", "cycles", &M::alternative, &A::taken),
      field("alternative.favourite", "cycles", &M::alternative, &A::favourite),
      field("timer.read", "cycles", &M::timer, &M::Timer::read),
      field("timer.wait_past", "cycles", &M::timer, &M::Timer::wait_past),
      field("timer.wait_future", "cycles", &M::timer, &M::Timer::wait_future),
      field("timer.high_tick", "s", &M::timer, &M::Timer::high_tick, 1e-12, 1e3),
      field("timer.low_tick", "s", &M::timer, &M::Timer::low_tick, 1e-12, 1e3),
      field("software.occam_factor", "1", &M::software, &M::Software::occam_factor),
      field("software.turn", "cycles", &M::software, &M::Software::turn),
      field("software.idle_period", "s", &M::software, &M::Software::idle_period),
      field("disk.seek", "s", &M::disk, &M::Disk::seek),
      field("disk.rate", "bytes/s", &M::disk, &M::Disk::rate, 1),
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

// A transputer supports three link rates, which a pin of the chip selects.
void check_bit_rate(const Model& model, std::string_view origin) {
  const double rate = model.link.bit_rate;
  base::require(rate == 5e6 || rate == 10e6 || rate == 20e6, origin,
                "link.bit_rate: found {}, expected 5e6, 10e6 or 20e6 (other links: set "
                "link.one_way_rate and link.both_ways_rate)",
                rate);
}

// Returns the required unit of an entry, or "" for an unknown key. The sections instruction,
// operation, scale and bytes accept any key, because programs add names of their own.
std::string unit_of(std::string_view key) {
  if (const auto* open = find_open(key)) return open->unit;
  const auto known = std::ranges::find(fields(), key, &Field::name);
  return known == fields().end() ? "" : known->unit;
}

// Copies the values of the entries into the members and maps of the model.
void bind_entries(Model& model, std::string_view origin) {
  for (const auto& known : fields()) {
    const auto entry = std::ranges::find(model.entries, known.name, &Entry::key);
    base::require(entry != model.entries.end(), origin, "{} is missing (unit {})", known.name,
                  known.unit);
    const auto expected = known.assign(model, entry->value);
    base::require(expected.empty(), entry->where, "found {}, expected {}", entry->value, expected);
  }
  check_bit_rate(model, origin);
  for (const Entry& entry : model.entries)
    if (const auto* open = find_open(entry.key)) {
      base::require(entry.value >= 0 && entry.value <= LARGEST_ENTRY, entry.where,
                    "found {}, expected a number from 0 to {}", entry.value, LARGEST_ENTRY);
      (model.*open->numbers)[entry.key.substr(open->prefix.size())] = entry.value;
    }
}

// Checks that a key is known. In sections that accept any key (see unit_of), a model with a base
// may change entries of the base, but must not add entries.
void check_key(const Model& model, const Entry& entry, bool has_base) {
  const bool known =
      std::ranges::find(model.entries, entry.key, &Entry::key) != model.entries.end();
  const std::string unit = unit_of(entry.key);
  if (unit.empty() || (find_open(entry.key) && has_base && !known)) {
    std::vector<std::string> keys;
    for (const auto& field : fields()) keys.push_back(field.name);
    for (const auto& e : model.entries) keys.push_back(e.key);
    base::refuse(entry.where, "unknown key{}",
                 base::suggest(entry.key, keys, "the nearest valid one is"));
  }
  base::require(entry.unit == unit, entry.where, "unit: found \"{}\", expected \"{}\"", entry.unit,
                unit);
}

void add(Model& model, Entry entry) {
  const auto same = std::ranges::find(model.entries, entry.key, &Entry::key);
  if (same == model.entries.end())
    model.entries.push_back(std::move(entry));
  else
    *same = std::move(entry);
}

// The indices of the entries that a formula refers to.
std::vector<std::size_t> find_needs(const Model& model, const base::Formula& formula,
                                    const std::map<std::string, std::size_t>& index_of) {
  std::vector<std::size_t> needs;
  for (const auto& name : formula.variables()) {
    if (const auto found = index_of.find(name); found != index_of.end()) {
      needs.push_back(found->second);
      continue;
    }
    std::vector<std::string> keys;
    for (const auto& e : model.entries) keys.push_back(e.key);
    base::refuse(formula.place(), "unknown name {}{}", name, base::suggest(name, keys));
  }
  return needs;
}

// Evaluates all formulas. A formula is evaluated after the entries that it refers to.
void eval_formulas(Model& model) {
  std::map<std::string, std::size_t> index_of;
  for (const Entry& entry : model.entries) index_of.emplace(entry.key, index_of.size());
  std::map<std::size_t, base::Formula> formulas;
  std::vector<std::vector<std::size_t>> needs(model.entries.size());
  for (std::size_t i = 0; i < needs.size(); ++i) {
    const Entry& entry = model.entries[i];
    if (entry.formula.empty()) continue;
    const auto place = fmt::format("{}: formula \"{}\"", entry.where, entry.formula);
    const auto& formula = formulas.try_emplace(i, entry.formula, place).first->second;
    needs[i] = find_needs(model, formula, index_of);
  }
  const auto order = base::sort_by_needs(needs);
  if (!order.circle.empty())
    base::refuse(formulas.at(order.circle[0]).place(),
                 "expected a formula that does not depend on itself");
  for (const auto i : order.sorted) {
    const auto formula = formulas.find(i);
    if (formula == formulas.end()) continue;
    std::vector<double> values;
    for (const auto needed : needs[i]) values.push_back(model.entries[needed].value);
    model.entries[i].value = formula->second.eval(values);
  }
}

// Place named in an error message, such as "my.toml:4".
std::string place_of(std::string_view origin, const toml::source_region& source) {
  return fmt::format("{}:{}", origin, source.begin.line);
}

std::optional<std::string> read_text(const toml::table& file, const char* key,
                                     std::string_view origin) {
  const auto* node = file.get(key);
  if (!node) return {};
  base::require(node->is_string(), place_of(origin, node->source()),
                "{}: expected a text in quotes", key);
  return node->value<std::string>();
}

// Loads a model by name or path. `inside` is the number of models that inherit, directly or not,
// from this one. If the name is unknown or the file unreadable, the error message starts with
// `where`.
Model load(std::string_view name, const std::filesystem::path& folder, int inside,
           const std::string& where);

// Reads the entries of a file and of its base without evaluating formulas.
Model parse(std::string_view text, std::string_view origin, const std::filesystem::path& folder,
            int inside) {
  const toml::table file = base::parse_toml(text, origin);
  Model model;
  const auto base_name = read_text(file, "base", origin);
  base::require(!base_name || inside <= 8, origin,
                "base: found a chain of bases without end, expected one that ends");
  if (base_name)
    model = load(*base_name, folder, inside + 1,
                 place_of(origin, file.get("base")->source()) + ": base: ");
  model.name = read_text(file, "name", origin).value_or("");
  model.base = model.name;
  base::require(!model.name.empty(), origin, "name is missing");
  std::vector<std::pair<toml::source_position, Entry>> entries;
  for (auto&& [section, content] : file) {
    if (section == "name" || section == "base") continue;
    base::require(content.is_table(), place_of(origin, content.source()), "{}: expected a section",
                  section.str());
    base::require(entries.size() + content.as_table()->size() <= MOST_ENTRIES, origin,
                  "found more than {0} entries, expected at most {0}", MOST_ENTRIES);
    for (auto&& [name, node] : *content.as_table()) {
      const auto key = fmt::format("{}.{}", section.str(), name.str());
      Entry entry = read_entry(key, node, place_of(origin, node.source()) + ": " + key);
      check_key(model, entry, base_name.has_value());
      entries.emplace_back(node.source().begin, std::move(entry));
    }
  }
  // toml++ sorts tables by name; this restores the order of the file.
  std::ranges::stable_sort(entries, {}, [](const auto& e) { return e.first.line; });
  for (auto& [line, entry] : entries) add(model, std::move(entry));
  return model;
}

Model load(std::string_view name, const std::filesystem::path& folder, int inside,
           const std::string& where) {
  for (const auto& [builtin, text] : BUILTIN_MODELS)
    if (name == builtin) return parse(text, fmt::format("model {}", builtin), folder, inside);
  if (!name.ends_with(".toml"))
    throw base::BadInput(fmt::format("{}unknown model \"{}\", expected {} or a .toml file", where,
                                     name, fmt::join(builtin_models(), ", ")));
  const auto path = folder / std::filesystem::path(name);
  std::string text;
  try {
    text = base::read_text(path);
  } catch (const base::BadInput& error) {
    throw base::BadInput(where + error.what());
  }
  return parse(text, path.string(), path.parent_path(), inside);
}

// Checks that the value of an entry lies in its range, if the range has the entry's unit, and that
// the formula `holds` is positive.
void check_ranges(const Model& model) {
  for (const Entry& entry : model.entries) {
    if (const auto& range = entry.range; range && !range->is_share)
      base::require(range->low <= entry.value && entry.value <= range->high, entry.where,
                    "low and high: found {} and {}, expected the value between them, {}",
                    range->low, range->high, entry.value);
    if (!entry.holds.empty())
      base::require(eval(model, entry.holds, entry.where + ": holds") > 0, entry.where,
                    "holds: expected a formula whose value is above 0");
  }
}

Model complete(Model model, std::string_view origin) {
  eval_formulas(model);
  bind_entries(model, origin);
  check_ranges(model);
  return model;
}

}  // namespace

double eval(const Model& model, const std::string& formula, const std::string& where) {
  std::map<std::string, std::size_t> index_of;
  for (const Entry& entry : model.entries) index_of.emplace(entry.key, index_of.size());
  const base::Formula parsed(formula, where);
  std::vector<double> values;
  for (const auto needed : find_needs(model, parsed, index_of))
    values.push_back(model.entries[needed].value);
  return parsed.eval(values);
}

Model parse_model(std::string_view text, std::string_view origin) {
  return complete(parse(text, origin, "", 0), origin);
}

Model load_model(std::string_view name) { return complete(load(name, "", 0, ""), name); }

std::string to_text(const EntryValue& value) {
  const auto* number = std::get_if<double>(&value);
  return number ? fmt::format("{}", *number) : fmt::format("\"{}\"", std::get<std::string>(value));
}

Model override_model(std::string_view name, const Overrides& entries, std::string_view origin) {
  Model model = load(name, "", 0, "");
  for (const auto& [key, value] : entries) {
    model.name +=
        fmt::format("{}{} = {}", &key == &entries[0].first ? " with " : ", ", key, to_text(value));
    Entry entry;
    entry.key = key;
    entry.unit = unit_of(key);
    entry.source = fmt::format("set by {}", origin);
    entry.where = fmt::format("{}: model.{}", origin, key);
    check_key(model, entry, true);
    set_value(entry, value);
    add(model, std::move(entry));
  }
  return complete(std::move(model), origin);
}

}  // namespace machine

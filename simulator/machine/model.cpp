#include "simulator/machine/model.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "simulator/machine/builtin_models.hpp"
#include "simulator/machine/faults.hpp"
#include "topologies/spelling.hpp"

namespace machine {

namespace {

// One field of Model: where its value goes and the unit its entry must carry.
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

const std::vector<Field>& fields() {
  using M = Model;
  static const std::vector<Field> all = {
      field("cpu.clock", "Hz", &M::cpu, &M::Cpu::clock),
      field("link.one_way_rate", "bytes/s", &M::link, &M::Link::one_way_rate),
      field("link.both_ways_rate", "bytes/s", &M::link, &M::Link::both_ways_rate),
      field("scheduler.slice", "cycles", &M::scheduler, &M::Scheduler::slice),
      field("scheduler.preemption", "cycles", &M::scheduler, &M::Scheduler::preemption),
      field("scheduler.return_to_low", "cycles", &M::scheduler, &M::Scheduler::return_to_low),
      field("scheduler.start_process", "cycles", &M::scheduler, &M::Scheduler::start_process),
      field("scheduler.end_process", "cycles", &M::scheduler, &M::Scheduler::end_process),
      field("channel.blocked", "cycles", &M::channel, &M::Channel::blocked),
      field("channel.soft_setup", "cycles", &M::channel, &M::Channel::soft_setup),
      field("channel.copy_word", "cycles", &M::channel, &M::Channel::copy_word),
      field("alternative.setup", "cycles", &M::alternative, &M::Alternative::setup),
      field("alternative.end", "cycles", &M::alternative, &M::Alternative::end),
      field("alternative.enable_ready", "cycles", &M::alternative, &M::Alternative::enable_ready),
      field("alternative.enable_not", "cycles", &M::alternative, &M::Alternative::enable_not),
      field("alternative.wait_ready", "cycles", &M::alternative, &M::Alternative::wait_ready),
      field("alternative.wait_not", "cycles", &M::alternative, &M::Alternative::wait_not),
      field("alternative.disable", "cycles", &M::alternative, &M::Alternative::disable),
      field("timer.read", "cycles", &M::timer, &M::Timer::read),
      field("timer.wait_past", "cycles", &M::timer, &M::Timer::wait_past),
      field("timer.wait_future", "cycles", &M::timer, &M::Timer::wait_future),
      field("timer.high_tick", "s", &M::timer, &M::Timer::high_tick),
      field("timer.low_tick", "s", &M::timer, &M::Timer::low_tick),
      field("software.occam_factor", "1", &M::software, &M::Software::occam_factor),
  };
  return all;
}

constexpr double LARGEST = 1e12;  // no entry is larger, in any unit

Provenance parse_provenance(const std::string& text, const std::string& where) {
  for (auto p :
       {Provenance::datasheet, Provenance::thesis, Provenance::calibrated, Provenance::assumed})
    if (text == to_string(p)) return p;
  throw InvalidInput(
      fmt::format("{}: provenance: found \"{}\", expected datasheet, thesis, calibrated or assumed",
                  where, text));
}

Entry parse_entry(const std::string& key, const toml::node& node, const std::string& where) {
  const auto* table = node.as_table();
  if (!table)
    throw InvalidInput(where +
                       ": expected { value = ..., unit = ..., provenance = ..., source = ... }");
  auto text = [&](const char* part) {
    auto value = (*table)[part].value<std::string>();
    if (!value) throw InvalidInput(fmt::format("{}: \"{}\" is missing or not a text", where, part));
    return *value;
  };
  for (auto&& [part, ignored] : *table)
    if (part != "value" && part != "unit" && part != "provenance" && part != "source")
      throw InvalidInput(fmt::format("{}: unknown part \"{}\"", where, part.str()));
  const auto value = (*table)["value"].value<double>();
  if (!value || !(*value >= 0 && *value <= LARGEST))
    throw InvalidInput(fmt::format("{}: \"value\" must be a number from 0 to {}", where, LARGEST));
  return {key, *value, text("unit"), parse_provenance(text("provenance"), where), text("source")};
}

// The maps of names that programs bring: a model built on another may change theirs, not add any.
std::map<std::string, double, std::less<>>* find_map(Model& model, std::string_view section) {
  if (section == "operation") return &model.operation;
  if (section == "scale") return &model.scale;
  if (section == "bytes") return &model.bytes;
  return nullptr;
}

void apply(Model& model, const Entry& entry, bool has_base, const std::string& where) {
  const auto dot = entry.key.find('.');
  const auto section = entry.key.substr(0, dot), name = entry.key.substr(dot + 1);
  const auto known = std::ranges::find(fields(), entry.key, &Field::key);
  auto* map = find_map(model, section);
  if (known == fields().end() && (!map || (has_base && !map->contains(name)))) {
    std::vector<std::string> keys;
    for (const auto& f : fields()) keys.push_back(f.key);
    for (const auto& e : model.entries) keys.push_back(e.key);
    throw InvalidInput(fmt::format("{}: unknown key, the nearest valid one is \"{}\"", where,
                                   topologies::nearest_name(entry.key, keys)));
  }
  const std::string unit = !map                     ? known->unit
                           : section == "operation" ? "cycles"
                           : section == "scale"     ? "1"
                                                    : "bytes";
  if (entry.unit != unit)
    throw InvalidInput(
        fmt::format("{}: unit: found \"{}\", expected \"{}\"", where, entry.unit, unit));
  if (map)
    (*map)[name] = entry.value;
  else
    known->set(model, entry.value);
}

void check_model(const Model& model, std::string_view origin) {
  for (const auto& known : fields())
    if (std::ranges::find(model.entries, known.key, &Entry::key) == model.entries.end())
      throw InvalidInput(fmt::format("{}: {} is missing (unit {})", origin, known.key, known.unit));
  for (const char* key : {"cpu.clock", "link.one_way_rate", "link.both_ways_rate",
                          "scheduler.slice", "timer.high_tick", "timer.low_tick"})
    if (std::ranges::find(model.entries, key, &Entry::key)->value <= 0)
      throw InvalidInput(fmt::format("{}: {}: found 0, expected a value above", origin, key));
}

// `inside`: how many files of this chain of bases are being read.
Model load(std::string_view name, const std::filesystem::path& folder, int inside);

Model parse(std::string_view text, std::string_view origin, const std::filesystem::path& folder,
            int inside) {
  Model model;
  toml::table file;
  try {
    file = toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    throw InvalidInput(
        fmt::format("{}:{}: {}", origin, error.source().begin.line, error.description()));
  }
  for (const char* key : {"base", "name"})
    if (const auto* node = file.get(key); node && !node->is_string())
      throw InvalidInput(fmt::format("{}:{}: {}: expected a text in quotes", origin,
                                     node->source().begin.line, key));
  const auto base = file["base"].value<std::string>();
  if (base && inside > 8) throw InvalidInput(fmt::format("{}: base: a chain without end", origin));
  if (base) model = load(*base, folder, inside + 1);
  model.name = file["name"].value_or(std::string());
  for (auto&& [section, content] : file) {
    if (section == "name" || section == "base") continue;
    const std::string where = fmt::format("{}:{}", origin, content.source().begin.line);
    if (!content.is_table())
      throw InvalidInput(fmt::format("{}: {}: expected a section", where, section.str()));
    for (auto&& [name, node] : *content.as_table()) {
      const auto key = fmt::format("{}.{}", section.str(), name.str());
      const auto place = fmt::format("{}:{}: {}", origin, node.source().begin.line, key);
      const Entry entry = parse_entry(key, node, place);
      apply(model, entry, base.has_value(), place);
      const auto same = std::ranges::find(model.entries, key, &Entry::key);
      same == model.entries.end() ? model.entries.push_back(entry) : void(*same = entry);
    }
  }
  if (model.name.empty()) throw InvalidInput(fmt::format("{}: name is missing", origin));
  check_model(model, origin);
  return model;
}

Model load(std::string_view name, const std::filesystem::path& folder, int inside) {
  for (const auto& [builtin, text] : BUILTIN_MODELS)
    if (name == builtin) return parse(text, fmt::format("model {}", builtin), folder, inside);
  if (!name.ends_with(".toml"))
    throw InvalidInput(fmt::format("unknown model \"{}\", expected {} or a .toml file", name,
                                   fmt::join(builtin_models(), ", ")));
  const auto path = folder / std::filesystem::path(name);
  std::ifstream in{path};
  const bool readable = in && std::filesystem::is_regular_file(path);
  const std::string text{
      readable ? std::istreambuf_iterator<char>(in) : std::istreambuf_iterator<char>(), {}};
  if (text.empty())
    throw InvalidInput(fmt::format("{}: the model file cannot be read", path.string()));
  return parse(text, path.string(), path.parent_path(), inside);
}

}  // namespace

std::string_view to_string(Provenance provenance) {
  constexpr std::string_view names[] = {"datasheet", "thesis", "calibrated", "assumed"};
  return names[static_cast<int>(provenance)];
}

Model parse_model(std::string_view text, std::string_view origin) {
  return parse(text, origin, "", 0);
}

Model load_model(std::string_view name) { return load(name, "", 0); }

std::uint64_t get_bytes(const Model& model, std::string_view name) {
  const auto found = model.bytes.find(name);
  if (found == model.bytes.end())
    throw InvalidInput(fmt::format("model {}: bytes.{} is missing", model.name, name));
  return static_cast<std::uint64_t>(found->second);
}

std::vector<std::string> builtin_models() {
  std::vector<std::string> names;
  for (const auto& [name, text] : BUILTIN_MODELS) names.emplace_back(name);
  return names;
}

std::string to_text(double value) {
  return value >= 1 && value == std::floor(value) ? fmt::format("{:.0f}", value)
                                                  : fmt::format("{:g}", value);
}

std::string describe(const Model& model) {
  std::string text = fmt::format("model {}\n", model.name);
  for (const auto& e : model.entries)
    text += fmt::format("{:<28} {:>12} {:<8} {:<11} {}\n", e.key, to_text(e.value), e.unit,
                        to_string(e.provenance), e.source);
  return text;
}

OperationCosts::OperationCosts(const Model& model, std::string_view kernel,
                               std::span<const std::string_view> names) {
  const auto scale = model.scale.find(kernel);
  if (scale == model.scale.end())
    throw InvalidInput(fmt::format("model {}: scale.{} is missing", model.name, kernel));
  for (auto name : names) {
    const auto cost = model.operation.find(name);
    if (cost == model.operation.end())
      throw InvalidInput(fmt::format("model {}: operation.{} is missing", model.name, name));
    cycles_.push_back(cost->second * scale->second);
  }
}

Cycles OperationCosts::operator()(std::span<const std::uint64_t> counts) const {
  check_equal("operations counted", counts.size(), cycles_.size());
  double cycles = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    cycles += static_cast<double>(counts[i]) * cycles_[i];
  return {std::llround(cycles)};
}

}  // namespace machine

// Reading model files: TOML, inheritance, formulas.
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/errors.hpp"
#include "base/formula.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "simulator/machine/builtin_models.hpp"
#include "simulator/machine/model_fields.hpp"

namespace machine {

namespace {

Provenance parse_provenance(const std::string& text, const std::string& where) {
  for (auto p :
       {Provenance::datasheet, Provenance::thesis, Provenance::calibrated, Provenance::assumed})
    if (text == to_string(p)) return p;
  throw base::BadInput(
      fmt::format("{}: provenance: found \"{}\", expected datasheet, thesis, calibrated or assumed",
                  where, text));
}

// A number, or a formula in quotes.
void read_value(Entry& entry, const toml::node* node) {
  if (const auto number = node ? node->value<double>() : std::nullopt)
    entry.value = *number;
  else if (const auto text = node ? node->value_exact<std::string>() : std::nullopt)
    base::Formula(entry.formula = *text, entry.where);
  else
    throw base::BadInput(fmt::format(
        "{}: \"value\" must be a number, or a formula in quotes over other entries", entry.where));
}

Entry read_entry(const std::string& key, const toml::node& node, const std::string& where) {
  const auto* table = node.as_table();
  if (!table)
    throw base::BadInput(where +
                         ": expected { value = ..., unit = ..., provenance = ..., source = ... }");
  auto text = [&](const char* part) {
    auto value = (*table)[part].value<std::string>();
    if (!value)
      throw base::BadInput(fmt::format("{}: \"{}\" is missing or not a text", where, part));
    return *value;
  };
  for (auto&& [part, ignored] : *table)
    if (part != "value" && part != "unit" && part != "provenance" && part != "source")
      throw base::BadInput(fmt::format("{}: unknown part \"{}\"", where, part.str()));
  Entry entry{
      key, 0, {}, text("unit"), parse_provenance(text("provenance"), where), text("source"), where};
  read_value(entry, table->get("value"));
  return entry;
}

// A model built on another may change the names that programs bring, not add any.
void check_key(const Model& model, const Entry& entry, bool has_base) {
  const bool known =
      std::ranges::find(model.entries, entry.key, &Entry::key) != model.entries.end();
  const std::string unit = unit_of(entry.key);
  if (unit.empty() || (is_open_section(entry.key) && has_base && !known)) {
    std::vector<std::string> keys = field_keys();
    for (const auto& e : model.entries) keys.push_back(e.key);
    throw base::BadInput(fmt::format("{}: unknown key, the nearest valid one is \"{}\"",
                                     entry.where, base::nearest_name(entry.key, keys)));
  }
  if (entry.unit != unit)
    throw base::BadInput(
        fmt::format("{}: unit: found \"{}\", expected \"{}\"", entry.where, entry.unit, unit));
}

void add(Model& model, Entry entry) {
  const auto same = std::ranges::find(model.entries, entry.key, &Entry::key);
  if (same == model.entries.end())
    model.entries.push_back(std::move(entry));
  else
    *same = std::move(entry);
}

// Computes the entries that are formulas, each after those it uses.
class Evaluation {
 public:
  explicit Evaluation(Model& model) : model_(model) {}
  void run() {
    for (Entry& entry : model_.entries) value_of(entry);
  }

 private:
  double value_of(Entry& entry) {
    if (entry.formula.empty() || done_.contains(entry.key)) return entry.value;
    if (!under_way_.insert(entry.key).second)
      throw base::BadInput(
          fmt::format("{}: formula \"{}\" depends on itself", entry.where, entry.formula));
    const base::Formula formula(entry.formula, entry.where);
    std::vector<double> values;
    for (const auto& name : formula.variables()) values.push_back(value_of(find(entry, name)));
    entry.value = formula.eval(values);
    done_.insert(entry.key);
    return entry.value;
  }
  Entry& find(const Entry& user, const std::string& name) {
    const auto found = std::ranges::find(model_.entries, name, &Entry::key);
    if (found != model_.entries.end()) return *found;
    std::vector<std::string> keys;
    for (const auto& e : model_.entries) keys.push_back(e.key);
    throw base::BadInput(fmt::format("{}: formula \"{}\": unknown name {}, the nearest is {}",
                                     user.where, user.formula, name,
                                     base::nearest_name(name, keys)));
  }

  Model& model_;
  std::set<std::string> under_way_, done_;
};

toml::table parse_toml(std::string_view text, std::string_view origin) {
  try {
    return toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    throw base::BadInput(
        fmt::format("{}:{}: {}", origin, error.source().begin.line, error.description()));
  }
}

std::optional<std::string> read_text(const toml::table& file, const char* key,
                                     std::string_view origin) {
  const auto* node = file.get(key);
  if (node && !node->is_string())
    throw base::BadInput(fmt::format("{}:{}: {}: expected a text in quotes", origin,
                                     node->source().begin.line, key));
  return node ? node->value<std::string>() : std::nullopt;
}

// `inside`: how many files of this chain of bases are being read.
Model load(std::string_view name, const std::filesystem::path& folder, int inside);

// The entries, not yet computed.
Model parse(std::string_view text, std::string_view origin, const std::filesystem::path& folder,
            int inside) {
  const toml::table file = parse_toml(text, origin);
  Model model;
  const auto base = read_text(file, "base", origin);
  if (base && inside > 8)
    throw base::BadInput(fmt::format("{}: base: a chain without end", origin));
  if (base) model = load(*base, folder, inside + 1);
  model.name = read_text(file, "name", origin).value_or("");
  if (model.name.empty()) throw base::BadInput(fmt::format("{}: name is missing", origin));
  std::vector<std::pair<toml::source_position, Entry>> entries;
  for (auto&& [section, content] : file) {
    if (section == "name" || section == "base") continue;
    if (!content.is_table())
      throw base::BadInput(fmt::format("{}:{}: {}: expected a section", origin,
                                       content.source().begin.line, section.str()));
    for (auto&& [name, node] : *content.as_table()) {
      const auto key = fmt::format("{}.{}", section.str(), name.str());
      Entry entry =
          read_entry(key, node, fmt::format("{}:{}: {}", origin, node.source().begin.line, key));
      check_key(model, entry, base.has_value());
      entries.emplace_back(node.source().begin, std::move(entry));
    }
  }
  // In the order of the file; TOML tables are sorted by name.
  std::ranges::stable_sort(entries, {}, [](const auto& e) { return e.first.line; });
  for (auto& [line, entry] : entries) add(model, std::move(entry));
  return model;
}

Model load(std::string_view name, const std::filesystem::path& folder, int inside) {
  for (const auto& [builtin, text] : BUILTIN_MODELS)
    if (name == builtin) return parse(text, fmt::format("model {}", builtin), folder, inside);
  if (!name.ends_with(".toml"))
    throw base::BadInput(fmt::format("unknown model \"{}\", expected {} or a .toml file", name,
                                     fmt::join(builtin_models(), ", ")));
  const auto path = folder / std::filesystem::path(name);
  return parse(base::read_text(path), path.string(), path.parent_path(), inside);
}

Model complete(Model model, std::string_view origin) {
  Evaluation(model).run();
  bind_entries(model, origin);
  return model;
}

}  // namespace

Model parse_model(std::string_view text, std::string_view origin) {
  return complete(parse(text, origin, "", 0), origin);
}

Model load_model(std::string_view name) { return complete(load(name, "", 0), name); }

Model override_model(std::string_view name,
                     const std::vector<std::pair<std::string, std::string>>& entries,
                     std::string_view origin) {
  Model model = load(name, "", 0);
  for (const auto& [key, toml] : entries) {
    model.name += fmt::format("{}{} = {}", &key == &entries[0].first ? " with " : ", ", key, toml);
    Entry entry{key,
                0,
                {},
                unit_of(key),
                Provenance::assumed,
                fmt::format("set by {}", origin),
                fmt::format("{}: model.{}", origin, key)};
    check_key(model, entry, true);
    const auto value = parse_toml("value = " + toml, entry.where);
    read_value(entry, value.get("value"));
    add(model, std::move(entry));
  }
  return complete(std::move(model), origin);
}

std::vector<std::string> builtin_models() {
  std::vector<std::string> names;
  for (const auto& [name, text] : BUILTIN_MODELS) names.emplace_back(name);
  return names;
}

}  // namespace machine

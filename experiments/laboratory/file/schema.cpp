#include "experiments/laboratory/file/schema.hpp"

#include <algorithm>
#include <filesystem>
#include <ranges>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/file/binding.hpp"
#include "experiments/laboratory/file/network_schema.hpp"

namespace laboratory {

namespace {

using base::BadInput;

std::vector<Binding<Experiment>> make_bindings() {
  using E = Experiment;
  using P = Place;
  const std::vector<Binding<E>> all = {
      {"title", "what the experiment is called",
       [](E& e, const P& at) { e.title = read_text(at); }},
      {"question", "what it answers", [](E& e, const P& at) { e.question = read_text(at); }},
      {"program.name", "one of the programs below, farm by default; an axis of its own, program",
       [](E&, const P&) {}},
      {"machine.model", "a processor model, or a model file",
       [](E& e, const P& at) { e.model = read_source(at); }},
      {"network.topology", "tree, line, ring, ... of `workers`; or a spec, tree:7; or a file",
       [](E& e, const P& at) { e.topology = read_source(at); }},
      {"network.workers", "worker processors",
       [](E& e, const P& at) { e.workers = read_int(at, 1, 16384); }},
      {"network.switches",
       "C004 link switches on every link: a number; or on some, [[a, b, n], ...]",
       [](E& e, const P& at) { read_switches(at, e.switches, e.switches_between); }},
      {"network.routes", "a CSV file with routes, from,to,path; others are the shortest",
       [](E& e, const P& at) { e.routes = read_file_name(at); }},
      {"network.tree", "of messages to all: per_root, breadth first from each; or single",
       [](E& e, const P& at) {
         e.tree = read_name(
             at, base::Names<std::string>{{"per_root", "per_root"}, {"single", "single"}});
       }},
      {"network.tree_links", "the links of the single tree, [[a, b], ...]",
       [](E& e, const P& at) { e.tree_links = read_tree_links(at); }},
      {"run.cost", "counted: operations times their cycles; timed: host time, scaled",
       [](E& e, const P& at) {
         e.is_timed = read_name(at, base::Names<bool>{{"counted", false}, {"timed", true}});
       }},
      {"fault", "[[fault]]: a link or a processor that breaks, at_s seconds into the run",
       [](E& e, const P& at) { e.faults = read_faults(at); }},
      // These belong to the file and not to a point: read_checks, read_plots and others read them.
      {"let", "[let]: names for expressions, to be used in checks",
       [](E&, const P& at) { at.refuse("no axis of this name"); }},
      {"check", "[[check]]: what the results are compared with",
       [](E&, const P& at) { at.refuse("no axis of this name"); }},
      {"plot", "[[plot]]: a figure of the report, in place of the usual ones",
       [](E&, const P& at) { at.refuse("no axis of this name"); }},
      {"best", "[[best]]: which value of some axes is best for each of others",
       [](E&, const P& at) { at.refuse("no axis of this name"); }},
      {"report", "[report]: what else is in the report",
       [](E&, const P& at) { at.refuse("no axis of this name"); }},
  };
  return all;
}

const std::vector<Binding<Experiment>>& bindings() {
  static const auto all = make_bindings();
  return all;
}

// The parameter of that key; null for none.
const programs::Parameter* find_parameter(const programs::Program& program,
                                          const std::string& key) {
  const auto found = std::ranges::find(program.parameters, key, &programs::key_of);
  return found == program.parameters.end() ? nullptr : &*found;
}

const programs::RecordList* find_list(const programs::Program& program, const std::string& key) {
  const auto found = std::ranges::find(program.lists, key, &programs::RecordList::key);
  return found == program.lists.end() ? nullptr : &*found;
}

bool has_key(const programs::Program& program, const std::string& key) {
  return find_parameter(program, key) || find_list(program, key);
}

bool is_common(const std::string& key) {
  return std::ranges::find(bindings(), key, &Binding<Experiment>::key) != bindings().end();
}

std::vector<std::string> names_of(const std::vector<programs::Program>& all) {
  std::vector<std::string> names;
  for (const auto& program : all) names.push_back(program.name);
  return names;
}

const programs::Program* read_program(const Place& at) {
  const std::string name = read_text(at);
  if (const auto* program = programs::find_program(name)) return program;
  const auto known = names_of(programs::all_programs());
  at.refuse(fmt::format("one of {} (did you mean \"{}\"?)", fmt::join(known, ", "),
                        base::nearest_name(name, known)));
}

// Sets a field, or says what was expected instead, of a choice with the nearest.
template <class P>
void assign(const base::Field<P>& field, P& params, const Place& at) {
  auto expected = field.assign(params, read_scalar(at, field.domain));
  if (expected.empty()) return;
  const auto text = at.node.value_exact<std::string>();
  if (text && !field.domain.choices.empty())
    expected +=
        fmt::format(" (did you mean \"{}\"?)", base::nearest_name(*text, field.domain.choices));
  at.refuse(expected);
}

[[noreturn]] void refuse_unknown(const Place& at, const std::vector<std::string>& known,
                                 const std::string& none) {
  throw BadInput(fmt::format("{}: unknown key \"{}\", {}", at.where(), at.key,
                             known.empty() ? none
                                           : fmt::format("the nearest valid key is \"{}\"",
                                                         base::nearest_name(at.key, known))));
}

// The tables of [[stage]]: each is a record.
void bind_list(Experiment& experiment, const programs::RecordList& list, const Place& at) {
  list.clear(experiment.params);
  for (const auto* table : read_tables(at)) {
    auto record = list.make_record();
    for (auto&& [key, node] : *table) {
      const Place place{at.origin, std::string(key.str()), at.folder, node};
      const auto field = std::ranges::find(list.fields, place.key, &programs::Parameter::name);
      if (field == list.fields.end()) {
        std::vector<std::string> known;
        for (const auto& f : list.fields) known.push_back(f.name);
        refuse_unknown(place, known, "");
      }
      assign(*field, record, place);
    }
    try {
      list.append(experiment.params, record);
    } catch (const BadInput& error) {
      throw BadInput(fmt::format("{}: {}", at.where(), error.what()));
    }
  }
}

// Takes the place of an entry of the machine model; its name is checked when the model is made.
void bind_model_entry(Experiment& experiment, const Place& at) {
  if (!at.node.is_number() && !at.node.is_string()) at.refuse("a number, or a formula in quotes");
  const auto entry = at.key.substr(at.key.find('.') + 1);
  auto& overrides = experiment.model_overrides;
  const auto known =
      std::ranges::find(overrides, entry, &std::pair<std::string, std::string>::first);
  if (known != overrides.end())
    known->second = to_toml(at.node);
  else
    overrides.emplace_back(entry, to_toml(at.node));
}

// Throws BadInput for a common key that no program in play has a use for.
void check_used(const Programs& in_play, const Place& at) {
  const auto refuse = [&](const char* what, bool programs::Uses::*uses) {
    if (std::ranges::any_of(in_play, [&](const auto* p) { return p->uses.*uses; })) return;
    std::vector<std::string> users;
    for (const auto& other : programs::all_programs())
      if (other.uses.*uses) users.push_back(other.name);
    throw BadInput(fmt::format("{}: {}: the program {} has no use for {}, expected one of {}",
                               at.where(), at.key, in_play[0]->name, what, fmt::join(users, ", ")));
  };
  const bool is_tree = at.key == "network.tree" || at.key == "network.tree_links";
  const auto has_network = [](const auto* program) { return program->uses.network; };
  if (at.key.starts_with("network.") && std::ranges::none_of(in_play, has_network))
    throw BadInput(
        fmt::format("{}: {}: the program {} has a network of its own, expected no [network]",
                    at.where(), at.key, in_play[0]->name));
  if (at.key == "network.routes" || is_tree) refuse("routes and trees", &programs::Uses::routes);
  if (at.key == "fault") refuse("faults", &programs::Uses::faults);
  if (at.key == "run.cost" && at.node.value_exact<std::string>() == "timed")
    refuse("timed costs", &programs::Uses::timed);
}

// A key that is nobody's here: another program's, or unknown.
[[noreturn]] void refuse_key(const Programs& in_play, const Place& at) {
  std::vector<std::string> known;
  for (const auto* program : in_play) {
    for (const auto& p : program->parameters) known.push_back(programs::key_of(p));
    for (const auto& list : program->lists) known.push_back(list.key);
  }
  const auto& name = in_play[0]->name;
  if (at.key.starts_with("program."))
    refuse_unknown(at, known, fmt::format("the program {} has no parameters", name));
  for (const auto& other : programs::all_programs())
    if (has_key(other, at.key))
      throw BadInput(fmt::format("{}: {} is a key of the {}, but program.name is \"{}\"",
                                 at.where(), at.key, other.name, name));
  for (const auto& common : bindings()) known.push_back(common.key);
  const auto same_end = std::ranges::find_if(
      known, [&](const std::string& key) { return key.ends_with("." + at.key); });
  if (same_end != known.end()) known = {*same_end};
  refuse_unknown(at, known, "");
}

void bind_key(Experiment& experiment, const Programs& in_play, const Place& at) {
  if (at.key.starts_with("model.")) return bind_model_entry(experiment, at);
  if (is_common(at.key)) {
    check_used(in_play, at);
    return bind_one(experiment, bindings(), at);
  }
  if (const auto* parameter = find_parameter(*experiment.program, at.key))
    return assign(*parameter, experiment.params, at);
  if (const auto* list = find_list(*experiment.program, at.key))
    return bind_list(experiment, *list, at);
  const bool is_others =
      std::ranges::any_of(in_play, [&](const auto* p) { return has_key(*p, at.key); });
  if (!is_others) refuse_key(in_play, at);
}

}  // namespace

Programs programs_in_play(const toml::table& file, const std::string& origin) {
  Programs found;
  const auto add = [&](const toml::node& node) {
    const auto* program = read_program({origin, "program.name", "", node});
    if (std::ranges::find(found, program) == found.end()) found.push_back(program);
  };
  if (const auto* sweep = file["sweep"].as_table())
    for (auto&& [names, values] : *sweep) {
      const auto all = split_names(names.str());
      for (std::size_t i = 0; i < all.size(); ++i) {
        if ((all[i] != "program" && all[i] != "program.name") || !values.is_array()) continue;
        for (const auto& value : *values.as_array()) {
          const auto* coupled = value.as_array();
          if (!coupled)
            add(value);
          else if (i < coupled->size())
            add(*coupled->get(i));
        }
      }
    }
  if (!found.empty()) return found;
  if (const auto name = file["program"]["name"])
    add(*name.node());
  else
    found.push_back(programs::find_program("farm"));
  return found;
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list;
    for (const auto& b : bindings()) list.push_back({b.key, b.help});
    for (const auto& setting : fault_settings()) list.push_back(setting);
    list.push_back({"model.SECTION.NAME", "takes the place of a number of the machine model"});
    for (const auto& setting : check_settings()) list.push_back(setting);
    for (const auto& setting : figure_settings()) list.push_back(setting);
    return list;
  }();
  return all;
}

void check_files(const Experiment& experiment) {
  for (const auto& p : experiment.program->parameters) {
    if (p.domain.kind != base::Domain::Kind::file) continue;
    const auto file = std::get<base::Source>(p.get(experiment.params));
    if (file.path.empty() && p.domain.is_required)
      throw BadInput(
          fmt::format("{}: found none, expected a file: {}", programs::key_of(p), p.help));
    if (!file.path.empty() && !std::filesystem::is_regular_file(file.path))
      throw BadInput(fmt::format("{}: found \"{}\", expected a file: there is none at {}",
                                 programs::key_of(p), file.text, file.path));
  }
}

std::vector<std::string> split_names(std::string_view name) {
  constexpr const char* AROUND = " \t\"'";
  std::vector<std::string> names;
  for (const auto part : std::views::split(name, ',')) {
    std::string text(part.begin(), part.end());
    text.erase(text.find_last_not_of(AROUND) + 1);
    names.push_back(text.erase(0, text.find_first_not_of(AROUND)));
  }
  return names;
}

Axis name_axis(const std::string& name, const Programs& in_play, const std::string& origin) {
  if (name.starts_with("model.")) return {name.substr(6), name, {}};
  if (name == "program" || name == "program.name") return {"program", "program.name", {}};
  std::vector<std::string> known;
  std::optional<Axis> found;
  const auto try_key = [&](const std::string& key) {
    const auto last = key.substr(key.rfind('.') + 1);
    if (!found && (name == last || name == key)) found = Axis{last, key, {}};
    known.push_back(last);
  };
  for (const auto* program : in_play)
    for (const auto& p : program->parameters) try_key(programs::key_of(p));
  for (const auto& common : bindings())
    if (common.key != "program.name") try_key(common.key);
  for (const auto* program : in_play)
    for (const auto& list : program->lists) try_key(list.key);
  const auto known_here = known;
  for (const auto& other : programs::all_programs())  // refused where its values are bound
    for (const auto& p : other.parameters) try_key(programs::key_of(p));
  if (found) return *found;
  throw BadInput(fmt::format("{}: unknown axis \"{}\" in [sweep], the nearest valid one is \"{}\"",
                             origin, name, base::nearest_name(name, known_here)));
}

Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const Programs& in_play, const std::string& origin,
                         const std::string& folder) {
  Experiment experiment;
  experiment.program = in_play[0];
  for (const auto& [key, value] : replacements)
    if (key == "program.name") experiment.program = read_program({origin, key, folder, *value});
  experiment.params = experiment.program->defaults;
  for_each_key(file, [&](const std::string& key, const toml::node& node) {
    bind_key(experiment, in_play, {origin, key, folder, node});
  });
  for (const auto& [key, value] : replacements)
    bind_key(experiment, in_play, {origin, key, folder, *value});
  return experiment;
}

}  // namespace laboratory

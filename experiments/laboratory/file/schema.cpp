#include "experiments/laboratory/file/schema.hpp"

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <filesystem>

#include "base/message.hpp"
#include "experiments/laboratory/file/tables.hpp"
#include "topologies/route/given_routes.hpp"

namespace laboratory {
namespace {

using base::BadInput;

constexpr int LAST = topologies::MAX_PROCESSORS - 1;

// Reads run.switches: one number for every link, or a list of [a, b, number] with processor numbers
// of the topology.
void read_switches(Experiment& e, const Place& at) {
  constexpr int MOST = 16;
  const std::string expected =
      fmt::format("a whole number from 0 to {}, or a list of [worker, worker, number]", MOST);
  if (at.node.is_integer()) {
    e.switches = static_cast<int>(read_int(at, 0, MOST));
    return;
  }
  const auto* list = at.node.as_array();
  if (!list) at.refuse(expected);
  e.switches_between.clear();
  for (const auto& node : *list) {
    const auto between = find_ints<3>(node, LAST);
    if (!between || between->back() > MOST) at.refuse(expected);
    e.switches_between.push_back(*between);
  }
}

// Reads the name of a routing method, or a file name.
void read_routes(Experiment& e, const Place& at) {
  const auto text = read_text(at);
  e.routes = text == topologies::XY_ROUTES ? base::Source{text, text} : read_file_name(at);
}

// Reads the links of a broadcast tree. Their ends are checked later, when the topology is known.
void read_tree_links(Experiment& e, const Place& at) {
  const std::string expected = "the links of a spanning tree, [[a, b], ...]";
  const auto* list = at.node.as_array();
  if (!list) at.refuse(expected);
  e.tree_links.clear();
  for (const auto& node : *list) {
    const auto link = find_ints<2>(node, LAST);
    if (!link) at.refuse(expected);
    e.tree_links.emplace_back((*link)[0], (*link)[1]);
  }
}

// Refuses an axis for a key that does not belong to points. read_judgement reads these keys.
Binding<Experiment> bind_to_file(const std::string& key, const std::string& help) {
  return {key, help, [](Experiment&, const Place& at) { at.refuse("no axis of this name"); }};
}

const Bindings<Experiment>& bindings() {
  using E = Experiment;
  static const base::Names<std::string> TREES = {{"per_root", "per_root"}, {"single", "single"}};
  static const base::Names<bool> COSTS = {{"counted", false}, {"timed", true}};
  static const base::Names<machine::Processes> PROCESSES = {{"fibers", machine::Processes::fibers},
                                                            {"actors", machine::Processes::actors}};
  static const base::Names<machine::Links> ENGINES = {{"simgrid", machine::Links::simgrid},
                                                      {"direct", machine::Links::direct}};
  static const Bindings<E> all = {
      bind_key("title", &E::title, "what the experiment is called"),
      bind_key("question", &E::question, "what it answers"),
      {"program.name", "one of the programs below, farm by default; an axis of its own, program",
       [](E&, const Place&) {}},
      {"machine.model", "a processor model, or a model file",
       [](E& e, const Place& at) { read(at, e.model.source); }},
      bind_key("network.topology", &E::topology,
               "tree, line, ring, ... of `workers`; or a spec, tree:7; or a file"),
      {"network.workers", "worker processors",
       [](E& e, const Place& at) { e.workers = read_int(at, 1, topologies::MAX_PROCESSORS); }},
      {"network.switches",
       "C004 link switches on every link: a number; or on some, [[a, b, n], ...]", read_switches},
      {"network.routes",
       "xy: dimension order, of meshes, tori and hypercubes; or a CSV file with routes, "
       "from,to,path; others are the shortest",
       read_routes},
      bind_name("network.tree", &E::tree, TREES,
                "of messages to all: per_root, breadth first from each; or single"),
      {"network.tree_links", "the links of the single tree, [[a, b], ...]", read_tree_links},
      bind_name("run.cost", &E::is_timed, COSTS,
                "counted: operations times their cycles; timed: host time, scaled; single rays are "
                "charged 10 to 18 % more than blocks"),
      bind_name("run.engine", &E::links, ENGINES,
                "what moves messages over links: simgrid; or direct, the same results to rounding, "
                "much less host time on large machines"),
      bind_name("run.processes", &E::processes, PROCESSES,
                "fibers; or actors of SimGrid: the same results, more host time"),
      {"fault", "[[fault]]: a link or a processor that breaks, at_s seconds into the run",
       [](E& e, const Place& at) { e.faults = read_faults(at); }},
      {"processor", "[[processor]]: one of the network that is of another model than the machine",
       [](E& e, const Place& at) { e.others = read_others(at); }},
      bind_to_file("let", "[let]: names for expressions, to be used in checks"),
      bind_to_file("check", "[[check]]: what the results are compared with"),
      bind_to_file("plot", "[[plot]]: a figure of the report, in place of the usual ones"),
      bind_to_file("best", "[[best]]: which value of some axes is best for each of others"),
      bind_to_file("baseline", "[[baseline]]: how many times as fast each row is as another"),
      bind_to_file("report", "[report]: what else is in the report"),
      bind_to_file("reduced", "[reduced]: values of other keys for a quick trial, with --reduced"),
      bind_to_file("uncertain", "[uncertain]: machines drawn from what their numbers may be"),
  };
  return all;
}

// Finds the item with this key; null if there is none.
template <class Item, class KeyOf>
const Item* find_by(const std::vector<Item>& items, KeyOf key_of, const std::string& key) {
  const auto found = std::ranges::find(items, key, key_of);
  return found == items.end() ? nullptr : &*found;
}

const programs::Parameter* find_parameter(const programs::Program& program,
                                          const std::string& key) {
  return find_by(program.parameters, programs::key_of, key);
}

const programs::RecordList* find_list(const programs::Program& program, const std::string& key) {
  return find_by(program.lists, &programs::RecordList::key, key);
}

bool has_key(const programs::Program& program, const std::string& key) {
  return find_parameter(program, key) || find_list(program, key);
}

bool is_common(const std::string& key) {
  return find_by(bindings(), &Binding<Experiment>::key, key);
}

const programs::Program* read_program(const Place& at) {
  const std::string name = read_text(at);
  if (const auto* program = programs::find_program(name)) return program;
  std::vector<std::string> known;
  for (const auto& program : programs::all_programs()) known.push_back(program.name);
  at.refuse(fmt::format("one of {}{}", fmt::join(known, ", "), base::did_you_mean(name, known)));
}

// Sets a field. Throws with the expected values, and for a choice also the nearest one.
template <class P>
void assign(const base::Field<P>& field, P& params, const Place& at) {
  auto expected = field.assign(params, read_scalar(at, field.domain));
  if (expected.empty()) return;
  const auto text = at.node.value_exact<std::string>();
  if (text && !field.domain.choices.empty())
    expected += base::did_you_mean(*text, field.domain.choices);
  at.refuse(expected);
}

// Reads the tables of a list such as [[stage]]. Each becomes a record.
void bind_list(Experiment& experiment, const programs::RecordList& list, const Place& at) {
  Bindings<std::any> bindings;
  for (const auto& field : list.fields)
    bindings.push_back({field.name, field.help,
                        [&](std::any& record, const Place& its) { assign(field, record, its); }});
  list.clear(experiment.params);
  for (const auto* table : tables_of(at)) {
    auto record = list.make_record();
    bind_all(record, bindings, *table, at);
    try {
      list.append(experiment.params, record);
    } catch (const BadInput& error) {
      throw BadInput(fmt::format("{}: {}", at.where(), error.what()));
    }
  }
}

// Overrides an entry of the machine model. Its name is checked later, when the model is made.
void bind_model_entry(Experiment& experiment, const Place& at) {
  if (!at.node.is_number() && !at.node.is_string()) at.refuse("a number, or a formula in quotes");
  const auto entry = at.key.substr(at.key.find('.') + 1);
  auto& entries = experiment.model.entries;
  std::erase_if(entries, [&](const auto& known) { return known.first == entry; });
  if (const auto number = at.node.value<double>(); number && at.node.is_number())
    entries.emplace_back(entry, *number);
  else
    entries.emplace_back(entry, *at.node.value_exact<std::string>());
}

// Throws BadInput for a common key that has no effect on any of the programs.
void check_used(const Programs& in_play, const Place& at) {
  const auto refuse = [&](const char* what, bool programs::Uses::*uses) {
    if (std::ranges::any_of(in_play, [&](const auto* p) { return p->uses.*uses; })) return;
    throw BadInput(fmt::format("{}: {}: the program {} has no use for {}, expected one of {}",
                               at.where(), at.key, in_play[0]->name, what, list_users(uses)));
  };
  const bool is_tree = at.key == "network.tree" || at.key == "network.tree_links";
  const auto has_network = [](const auto* program) { return program->uses.network; };
  if (at.key.starts_with("network.") && std::ranges::none_of(in_play, has_network))
    throw BadInput(
        fmt::format("{}: {}: the program {} has a network of its own, expected no [network]",
                    at.where(), at.key, in_play[0]->name));
  if (at.key == "network.routes" || is_tree) refuse("routes and trees", &programs::Uses::routes);
  if (at.key == "fault") refuse("faults", &programs::Uses::faults);
  if (at.key == "processor") refuse("processors of other models", &programs::Uses::others);
  if (at.key == "run.cost" && at.node.value_exact<std::string>() == "timed")
    refuse("timed costs", &programs::Uses::timed);
}

// Throws for an unknown key, and for a key of another program.
[[noreturn]] void refuse_unknown(const Programs& in_play, const Place& at) {
  std::vector<std::string> known;
  for (const auto* program : in_play) {
    for (const auto& p : program->parameters) known.push_back(programs::key_of(p));
    for (const auto& list : program->lists) known.push_back(list.key);
  }
  const auto& name = in_play[0]->name;
  if (at.key.starts_with("program.")) {
    base::require(!known.empty(), at.where(),
                  "unknown key \"{}\", the program {} has no parameters", at.key, name);
    refuse_key(at, known);
  }
  for (const auto& other : programs::all_programs())
    base::require(!has_key(other, at.key), at.where(),
                  "{} is a key of the {}, but program.name is \"{}\"", at.key, other.name, name);
  for (const auto& common : bindings()) known.push_back(common.key);
  refuse_key(at, known);
}

void bind_setting(Experiment& experiment, const Programs& in_play, const Place& at) {
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
  if (!is_others) refuse_unknown(in_play, at);
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

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const auto& b : bindings()) all.push_back({b.key, b.help});
  std::ranges::copy(table_settings(), std::back_inserter(all));
  return all;
}

void check_files(const Experiment& experiment) {
  for (const auto& p : experiment.program->parameters) {
    if (p.domain.kind != base::Domain::Kind::file) continue;
    const auto file = std::get<base::Source>(p.get(experiment.params));
    const auto key = programs::key_of(p);
    base::require(!file.path.empty() || !p.domain.is_required, key,
                  "found none, expected a file: {}", p.help);
    base::require(file.path.empty() || std::filesystem::is_regular_file(file.path), key,
                  "found \"{}\", expected a file: there is none at {}", file.text, file.path);
  }
}

std::string list_users(bool programs::Uses::*of) {
  std::vector<std::string> names;
  for (const auto& program : programs::all_programs())
    if (program.uses.*of) names.push_back(program.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> split_names(std::string_view name) {
  std::vector<std::string> names;
  for (const auto part : base::split(name, ','))
    names.push_back(boost::trim_copy_if(std::string(part), boost::is_any_of(" \t\"'")));
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
  // parameters of programs that the file does not use: known names, but binding their values fails
  for (const auto& other : programs::all_programs())
    for (const auto& p : other.parameters) try_key(programs::key_of(p));
  if (found) return *found;
  throw BadInput(fmt::format("{}: unknown axis \"{}\" in [sweep]{}", origin, name,
                             base::suggest(name, known_here, "the nearest valid one is")));
}

Experiment bind_settings(const toml::table& file, const std::vector<Coordinate>& at,
                         const Programs& in_play, const std::string& origin,
                         const std::string& folder) {
  Experiment experiment;
  experiment.program = in_play[0];
  for (const auto& [axis, key, value] : at)
    if (key == "program.name") experiment.program = read_program({origin, key, folder, *value});
  experiment.params = experiment.program->defaults;
  for_each_key(file, [&](const std::string& key, const toml::node& node) {
    bind_setting(experiment, in_play, {origin, key, folder, node});
  });
  for (const auto& [axis, key, value] : std::views::reverse(at))
    bind_setting(experiment, in_play, {origin, key, folder, *value});
  base::require(experiment.links == machine::Links::simgrid ||
                    experiment.processes == machine::Processes::fibers,
                origin + ": run.processes",
                "found actors with run.engine = \"direct\", expected fibers: actors are SimGrid's");
  return experiment;
}

}  // namespace laboratory

#include "experiments/laboratory/file/schema.hpp"

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <filesystem>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/file/tables.hpp"
#include "topologies/route/given_routes.hpp"

namespace laboratory {
namespace {

using base::BadInput;

constexpr int MOST_SWITCHES = 16;

// Sets the number of switches on every link, or on some links by a list of [a, b, number], where a
// and b are processors of the topology.
bool set_switches(Experiment& e, const base::Scalar& value) {
  if (const auto* all = std::get_if<std::int64_t>(&value)) {
    if (*all < 0 || *all > MOST_SWITCHES) return false;
    e.switches = static_cast<int>(*all);
    return true;
  }
  const auto between = find_rows<3>(value, LAST_PROCESSOR);
  if (!between ||
      std::ranges::any_of(*between, [](const auto& row) { return row.back() > MOST_SWITCHES; }))
    return false;
  e.switches_between = *between;
  return true;
}

// Sets the routes: the name of a routing method, or a file.
bool set_routes(Experiment& e, const base::Scalar& value) {
  e.routes = std::get<base::Source>(value);
  if (e.routes.text == topologies::XY_ROUTES) e.routes.path = e.routes.text;
  return true;
}

// Sets the links of a broadcast tree. Their processors are checked later, when the topology is
// known.
bool set_tree_links(Experiment& e, const base::Scalar& value) {
  const auto links = find_rows<2>(value, LAST_PROCESSOR);
  if (!links) return false;
  e.tree_links.clear();
  for (const auto& [a, b] : *links) e.tree_links.emplace_back(a, b);
  return true;
}

// The key program.name. It is read before all other keys, since their meaning depends on the
// program.
base::Field<Experiment> program_field() {
  base::Domain names{base::Domain::Kind::choice};
  for (const auto& program : programs::all_programs()) names.choices.push_back(program.name);
  return base::Declare<Experiment>::custom(
      "program.name", names, "", "one of the programs below; as an axis of [sweep]: program",
      [](Experiment&, const base::Scalar&) { return true; },
      [](const Experiment& e) {
        return (e.program ? *e.program : programs::all_programs().front()).name;
      });
}

// The keys that do not depend on the program.
const base::Fields<Experiment>& common_fields() {
  using E = Experiment;
  using D = base::Declare<E>;
  static const base::Names<bool> COSTS = {{"counted", false}, {"timed", true}};
  static const base::Names<machine::Processes> PROCESSES = {{"fibers", machine::Processes::fibers},
                                                            {"actors", machine::Processes::actors}};
  static const base::Names<machine::Links> ENGINES = {{"simgrid", machine::Links::simgrid},
                                                      {"direct", machine::Links::direct}};
  base::Domain switches{base::Domain::Kind::any}, tree_links = switches;
  switches.expected = fmt::format(
      "a whole number from 0 to {}, or a list of [worker, worker, number]", MOST_SWITCHES);
  tree_links.expected = "the links of a spanning tree, [[a, b], ...]";
  static const base::Fields<E> all = {
      D::text("title", &E::title, "title of the experiment"),
      D::text("question", &E::question, "question that the experiment answers"),
      program_field(),
      D::source(
          "machine.model", [](auto& e) -> auto& { return e.model.source; },
          "machine model: a built-in one, or a model file"),
      D::source(
          "network.topology", &E::topology,
          "tree, line, ring, ... of `workers` processors; or with sizes, as tree:7; or a file"),
      D::whole("network.workers", &E::workers, 1, topologies::MAX_PROCESSORS, "",
               "worker processors"),
      D::custom("network.switches", switches, "",
                "C004 link switches: a number for every link, or for some links [[a, b, n], ...]",
                set_switches, [](const E& e) { return std::int64_t{e.switches}; }),
      D::custom("network.routes", {base::Domain::Kind::file}, "",
                "xy: dimension-order routing on meshes, tori and hypercubes; or a CSV file with "
                "the columns from,to,path; default: shortest routes",
                set_routes, std::mem_fn(&E::routes)),
      D::one_of("network.tree", &E::tree, {"per_root", "single"},
                "spanning trees for messages to all: per_root, breadth first from each sender; or "
                "single, one tree for all"),
      D::custom("network.tree_links", tree_links, "", "links of the single tree, [[a, b], ...]",
                set_tree_links, [](const E&) { return base::Scalar(); }),
      D::whole("run.repetitions", &E::repetitions, 1, 10'000, "",
               "number of seeds: runs each point with so many consecutive seeds, as an axis of "
               "[sweep] would"),
      D::choice("run.cost", &E::is_timed, COSTS,
                "counted: operations times their cycles; timed: scaled host time, which charges "
                "single rays 10 to 18 % more than blocks"),
      D::choice(
          "run.engine", [](auto& e) -> auto& { return e.engine.links; }, ENGINES,
          "engine that simulates links: simgrid; or direct, which gives the same results "
          "except for rounding and is much faster for large machines"),
      D::choice(
          "run.processes", [](auto& e) -> auto& { return e.engine.processes; }, PROCESSES,
          "implementation of processes: fibers; or actors of SimGrid, which give the same "
          "results in more host time"),
  };
  return all;
}

// A section or list of tables of the experiment file whose keys do not belong to a program, such as
// [[fault]].
struct Section {
  std::string key, help;
  /// Reads the section into the settings of a point. Null for sections that are not part of a
  /// point's settings: these cannot be axes, and read_judgement() reads them.
  void (*read)(Experiment&, const Place&) = nullptr;
};

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {"fault", "[[fault]]: a link or a processor that fails at_s seconds after the start",
       [](Experiment& e, const Place& at) { e.faults = read_faults(at); }},
      {"processor", "[[processor]]: a processor of the network with another model than the machine",
       [](Experiment& e, const Place& at) { e.others = read_others(at); }},
      {"sweep", "[sweep]: axes, keys with several values each; every combination is a point"},
      {"let", "[let]: names for expressions in checks"},
      {"check", "[[check]]: comparison of results with a formula, bounds or a reference"},
      {"plot", "[[plot]]: a plot of the report; replaces the default plots"},
      {"best", "[[best]]: search for the best values of some axes, for each value of others"},
      {"baseline", "[[baseline]]: speed-up of each row relative to another"},
      {"report", "[report]: other parts of the report"},
      {"reduced", "[reduced]: values of keys for a quick trial with --reduced"},
      {"uncertain", "[uncertain]: machines drawn from the ranges of the model's entries"},
  };
  return all;
}

// Finds the item whose key is `key`; null if there is none.
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

const programs::Program* read_program(const Place& at) {
  static const auto domain = program_field().domain;
  return programs::find_program(std::get<std::string>(read_value(at, domain)));
}

// Reads the tables of a list of the program, such as [[stage]]. Each table becomes a record.
void bind_list(Experiment& experiment, const programs::RecordList& list, const Place& at) {
  list.clear(experiment.params);
  check_tables(at);
  for (const auto& table : *at.node.as_array()) {
    auto record = list.make_record();
    assign_all(record, list.fields, *table.as_table(), at);
    base::at_place(at.where(), [&] { list.append(experiment.params, record); });
  }
}

// Overrides an entry of the machine model. The entry's name is checked later, when the model is
// made.
void bind_model_entry(Experiment& experiment, const Place& at) {
  if (!at.node.is_number() && !at.node.is_string()) at.refuse("a number, or a formula in quotes");
  const auto entry = at.key.substr(at.key.find('.') + 1);
  auto& entries = experiment.model.entries;
  const auto known = std::ranges::find(entries, entry, &machine::Overrides::value_type::first);
  auto& value = known != entries.end() ? known->second : entries.emplace_back(entry, 0.0).second;
  if (at.node.is_number())
    value = *at.node.value<double>();
  else
    value = *at.node.value_exact<std::string>();
}

// Throws BadInput if a key common to all programs has no effect on any program of this experiment.
void check_used(const Programs& in_play, const Place& at) {
  const auto refuse = [&](const char* what, bool programs::Uses::*uses) {
    if (std::ranges::any_of(in_play, [&](const auto* p) { return p->uses.*uses; })) return;
    throw BadInput(fmt::format("{}: {}: the program {} does not support {}, expected one of {}",
                               at.where(), at.key, in_play[0]->name, what, list_users(uses)));
  };
  const bool is_tree = at.key == "network.tree" || at.key == "network.tree_links";
  const auto has_network = [](const auto* program) { return program->uses.network; };
  if (at.key.starts_with("network.") && std::ranges::none_of(in_play, has_network))
    throw BadInput(fmt::format("{}: {}: the program {} has its own network, expected no [network]",
                               at.where(), at.key, in_play[0]->name));
  if (at.key == "network.routes" || is_tree) refuse("routes and trees", &programs::Uses::routes);
  if (at.key == "fault") refuse("faults", &programs::Uses::faults);
  if (at.key == "processor") refuse("processors of other models", &programs::Uses::others);
  if (at.key == "run.cost" && at.node.value_exact<std::string>() == "timed")
    refuse("timed costs", &programs::Uses::timed);
}

std::vector<std::string> common_keys() {
  std::vector<std::string> keys;
  for (const auto& field : common_fields()) keys.push_back(field.name);
  for (const auto& section : sections()) keys.push_back(section.key);
  return keys;
}

// Throws for a key that is unknown or belongs to another program.
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
  for (const auto& key : common_keys()) known.push_back(key);
  refuse_key(at, known);
}

// The data member that a key sets, in the experiment or in the parameters of its program.
struct Member {
  void* place;
  const base::Domain& domain;
  const std::function<bool(void*, const base::Scalar&)>& write;
};

std::optional<Member> find_member(Experiment& e, const std::string& key) {
  if (const auto* field = find_by(common_fields(), &base::Field<Experiment>::name, key))
    return Member{field->place(e), field->domain, field->write};
  if (const auto* parameter = find_parameter(*e.program, key))
    return Member{parameter->place(e.params), parameter->domain, parameter->write};
  return std::nullopt;
}

// Reads a section such as [[fault]], or a list of the program such as [[stage]].
void bind_tables(Experiment& experiment, const Programs& in_play, const Place& at) {
  if (const auto* section = find_by(sections(), &Section::key, at.key)) {
    check_used(in_play, at);
    if (!section->read) at.refuse("no axis of this name");
    return section->read(experiment, at);
  }
  if (const auto* list = find_list(*experiment.program, at.key))
    return bind_list(experiment, *list, at);
  const bool is_others =
      std::ranges::any_of(in_play, [&](const auto* p) { return has_key(*p, at.key); });
  if (!is_others) refuse_unknown(in_play, at);
}

}  // namespace

Programs programs_in_play(const toml::table& file, const std::vector<Coupled>& sweep,
                          const std::string& origin) {
  Programs found;
  const auto add = [&](const toml::node& node) {
    const auto* program = read_program({origin, "program.name", "", node});
    if (std::ranges::find(found, program) == found.end()) found.push_back(program);
  };
  for (const auto& coupled : sweep)
    for (const auto& axis : coupled)
      if (axis.name == "program" || axis.name == "program.name")
        for (const auto& value : axis.values) add(*value);
  if (!found.empty()) return found;
  if (const auto name = file["program"]["name"])
    add(*name.node());
  else
    found.push_back(&programs::all_programs().front());
  return found;
}

std::string describe_default(const base::Domain& domain, const base::Scalar& standard) {
  const auto text = base::to_text(standard);
  if (domain.kind != base::Domain::Kind::flag) return text;
  return text == "1" ? "true" : text == "0" ? "false" : text;
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  add_settings(all, common_fields(), "");
  for (const auto& section : sections()) all.push_back({section.key, section.help});
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
                  "found \"{}\", expected an existing file: there is none at {}", file.text,
                  file.path);
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
  for (const auto& key : common_keys())
    if (key != "program.name") try_key(key);
  for (const auto* program : in_play)
    for (const auto& list : program->lists) try_key(list.key);
  const auto known_here = known;
  // Accepts parameters of other programs here, because assigning their values later throws an error
  // that names the right program.
  for (const auto& other : programs::all_programs())
    for (const auto& p : other.parameters) try_key(programs::key_of(p));
  if (found) return *found;
  throw BadInput(fmt::format("{}: unknown axis \"{}\" in [sweep]{}", origin, name,
                             base::suggest(name, known_here, "the nearest valid one is")));
}

Experiment bind_settings(const ExperimentFile& file, const std::vector<Coordinate>& at,
                         const Programs& in_play) {
  Experiment experiment;
  experiment.program = in_play[0];
  std::vector<Place> places;
  for (const auto& [key, node] : file.keys) places.push_back({file.path, key, file.folder, *node});
  for (const auto& [axis, key, value] : std::views::reverse(at))
    places.push_back({file.path, key, file.folder, *value});
  for (const auto& [axis, key, value] : at)
    if (key == "program.name") experiment.program = read_program({file.path, key, "", *value});
  experiment.params = experiment.program->defaults;
  for (const auto& place : places) {
    if (place.key.starts_with("model.")) {
      bind_model_entry(experiment, place);
    } else if (const auto member = find_member(experiment, place.key)) {
      check_used(in_play, place);
      if (!member->write(member->place, read_value(place, member->domain)))
        place.refuse(member->domain.describe());
    } else {
      bind_tables(experiment, in_play, place);
    }
  }
  base::require(
      experiment.engine.links == machine::Links::simgrid ||
          experiment.engine.processes == machine::Processes::fibers,
      file.path + ": run.processes",
      "found actors with run.engine = \"direct\", expected fibers: only SimGrid has actors");
  return experiment;
}

}  // namespace laboratory

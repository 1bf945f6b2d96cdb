#include "experiments/laboratory/file/schema.hpp"

#include <algorithm>
#include <filesystem>
#include <ranges>

#include "base/errors.hpp"
#include "base/spelling.hpp"
#include "experiments/laboratory/file/binding.hpp"
#include "experiments/laboratory/file/data_schema.hpp"
#include "experiments/laboratory/file/image_names.hpp"
#include "experiments/laboratory/file/network_schema.hpp"
#include "experiments/laboratory/file/program.hpp"

namespace laboratory {

namespace {

using base::BadInput;

constexpr std::int64_t MANY = 1'000'000'000;

const std::vector<Binding<farm::Limits>>& limit_bindings() {
  using L = farm::Limits;
  static const std::vector<Binding<L>> all = {
      {"min_influence", "influence factor, at least; 0..1",
       [](L& l, const Place& at) { l.min_influence = read_double(at, 0, 1); }},
      {"depth_reflected", "tree level, at most, of rays with only reflections before them",
       [](L& l, const Place& at) { l.depth_reflected = int(read_int(at, 0, 1000)); }},
      {"depth_transmitted", "tree level, at most, of transmitted rays and their descendants",
       [](L& l, const Place& at) { l.depth_transmitted = int(read_int(at, 0, 1000)); }},
      {"min_cell", "size of the image cell, at least; pixels",
       [](L& l, const Place& at) { l.min_cell = int(read_int(at, 1, 65536)); }},
      {"area", "area of interest, [x, y, width, height]; pixels",
       [](L& l, const Place& at) { l.area = read_area(at); }},
  };
  return all;
}

struct OrderRecord {
  double at_s = 0;
  bool non_interactive = false;
  farm::Limits limits;
};

farm::Order bind_order(const toml::table& table, const Place& at) {
  static const std::vector<Binding<OrderRecord>> own = {
      {"at_s", "", [](OrderRecord& o, const Place& p) { o.at_s = read_double(p, 0, 1e9); }},
      {"non_interactive", "",
       [](OrderRecord& o, const Place& p) { o.non_interactive = read_bool(p); }}};
  OrderRecord order;
  std::size_t limits = 0;
  for (auto&& [key, node] : table) {
    const Place place{at.origin, std::string(key.str()), at.folder, node};
    if (std::ranges::find(limit_bindings(), place.key, &Binding<farm::Limits>::key) !=
        limit_bindings().end()) {
      bind_one(order.limits, limit_bindings(), place);
      ++limits;
    } else {
      bind_one(order, own, place);
    }
  }
  if (order.non_interactive == (limits > 0))
    throw BadInput(
        fmt::format("{}: [[order]] at {} s: expected either limits or non_interactive = true",
                    at.where(), order.at_s));
  farm::Command command;
  if (order.non_interactive)
    command.content = farm::NonInteractive{};
  else
    command.content = order.limits;
  return {{order.at_s}, command};
}

std::vector<Binding<Experiment>> make_bindings() {
  using E = Experiment;
  using P = Place;
  std::vector<Binding<E>> all = {
      {"title", "what the experiment is called",
       [](E& e, const P& at) { e.title = read_text(at); }},
      {"question", "what it answers", [](E& e, const P& at) { e.question = read_text(at); }},
      {"program.name", "farm, or one of the programs below; its parameters are keys beside it",
       [](E& e, const P& at) { e.program = read_text(at); }},
      {"machine.model", "a processor model, or a model file",
       [](E& e, const P& at) { e.model = read_source(at); }},
      {"machine.worker_memory_bytes", "memory of a worker and of the coordinator; bytes",
       [](E& e, const P& at) {
         e.farm.worker_memory = std::uint64_t(read_int(at, 1, std::int64_t(1) << 40));
       }},
      {"machine.database_memory_bytes", "memory of the ray database and of the display; bytes",
       [](E& e, const P& at) {
         e.farm.database_memory = std::uint64_t(read_int(at, 1, std::int64_t(1) << 40));
       }},
      {"network.topology", "tree, line, ring, ... of `workers`; or a spec, tree:7; or a file",
       [](E& e, const P& at) { e.topology = read_source(at); }},
      {"network.workers", "worker processors",
       [](E& e, const P& at) { e.workers = read_int(at, 1, 16384); }},
      {"network.switches",
       "C004 link switches on every link: a number; or on some, [[a, b, n], ...]",
       [](E& e, const P& at) { read_switches(at, e.switches, e.switches_between); }},
      {"network.routes", "a CSV file with routes, from,to,path; others are the shortest",
       [](E& e, const P& at) {
         const auto name = read_text(at);
         e.routes = name.empty() ? "" : (std::filesystem::path(at.folder) / name).string();
       }},
      {"network.tree", "of messages to all: per_root, breadth first from each; or single",
       [](E& e, const P& at) {
         e.tree = read_name(at, Names<std::string>{{"per_root", "per_root"}, {"single", "single"}});
       }},
      {"network.tree_links", "the links of the single tree, [[a, b], ...]",
       [](E& e, const P& at) { e.tree_links = read_tree_links(at); }},
      {"scene.source", "spheres (made of `objects`), a spec, spheres:200; or an NFF file",
       [](E& e, const P& at) { e.scene = read_source(at); }},
      {"scene.objects", "spheres in a generated scene",
       [](E& e, const P& at) { e.objects = read_int(at, 1, MANY); }},
      {"image.width", "pixels",
       [](E& e, const P& at) { e.farm.image.width = int(read_int(at, 1, 65536)); }},
      {"image.height", "pixels",
       [](E& e, const P& at) { e.farm.image.height = int(read_int(at, 1, 65536)); }},
      {"image.depth", "levels of the shading tree",
       [](E& e, const P& at) { e.farm.image.limits.depth = int(read_int(at, 1, 1000)); }},
      {"image.min_influence", "no ray is made below this influence factor; 0..1",
       [](E& e, const P& at) { e.farm.image.limits.min_influence = read_double(at, 0, 1); }},
      {"image.feelers", "all: to every light; front: to those in front of the surface",
       [](E& e, const P& at) { e.farm.image.feelers = read_name(at, FEELERS); }},
      {"image.sample", "where in its pixel: corner, center, or lattice (edge to edge)",
       [](E& e, const P& at) { e.farm.image.sample = read_name(at, SAMPLES); }},
      {"image.traversal", "of the hierarchy: exhaustive (the thesis's), nearest or linear",
       [](E& e, const P& at) { e.farm.image.traversal = read_name(at, TRAVERSALS); }},
      {"image.ambient", "intensity of ambient light; 0..1000",
       [](E& e, const P& at) { e.farm.image.ambient = read_double(at, 0, 1000); }},
      {"image.area", "area of interest, [x, y, width, height]; pixels",
       [](E& e, const P& at) { e.farm.image.area = read_area(at); }},
      {"farm.max_cell", "largest image cell, a power of two; pixels",
       [](E& e, const P& at) { e.farm.max_cell = int(read_int(at, 1, 65536)); }},
      {"farm.task", "what a worker is given: ray, or a block of pixels, block:8x8",
       [](E& e, const P& at) { e.farm.block = read_task(at); }},
      {"farm.scene_message_bytes",
       "of a message when the scene is first sent to all workers, in setup_s; 0: they have it",
       [](E& e, const P& at) { e.farm.scene_message = std::uint32_t(read_int(at, 0, 1 << 24)); }},
      {"farm.seed", "of the order of the cells",
       [](E& e, const P& at) { e.farm.seed = std::uint64_t(read_int(at, 0, INT64_MAX)); }},
      {"run.cost", "counted: operations times their cycles; timed: host time, scaled",
       [](E& e, const P& at) {
         e.cost = read_name(at, Names<std::string>{{"counted", "counted"}, {"timed", "timed"}});
       }},
      {"stage", "[[stage]]: limits of the interactive phase, one set after the other",
       [](E& e, const P& at) {
         e.farm.stages.clear();
         for (const auto& table : read_tables(at)) {
           auto& limits = e.farm.stages.emplace_back();
           for (auto&& [key, node] : *table)
             bind_one(limits, limit_bindings(), {at.origin, std::string(key.str()), "", node});
         }
       }},
      {"order", "[[order]]: what the user orders, at_s seconds into the run",
       [](E& e, const P& at) {
         e.farm.script.clear();
         for (const auto& table : read_tables(at)) e.farm.script.push_back(bind_order(*table, at));
       }},
      {"fault", "[[fault]]: a link or a processor that breaks, at_s seconds into the run",
       [](E& e, const P& at) { e.faults = read_faults(at); }},
      // Of the file, not of a point: read_checks, read_plots and others read them.
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
  const auto run = std::ranges::find(all, "run.cost", &Binding<E>::key);
  all.insert(run, data_bindings().begin(), data_bindings().end());
  return all;
}

const std::vector<Binding<Experiment>>& bindings() {
  static const auto all = make_bindings();
  return all;
}

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list;
    for (const auto& b : bindings()) list.push_back({b.key, b.help});
    for (const auto& b : limit_bindings())
      list.push_back({"stage." + b.key, b.help + " (also in [[order]])"});
    list.push_back({"order.at_s", "when the user orders it, from the start of the program; s"});
    list.push_back({"order.non_interactive", "true: the user leaves the interactive phase"});
    for (const auto& setting : fault_settings()) list.push_back(setting);
    list.push_back({"model.SECTION.NAME", "takes the place of a number of the machine model"});
    for (const auto& setting : check_settings()) list.push_back(setting);
    for (const auto& setting : figure_settings()) list.push_back(setting);
    return list;
  }();
  return all;
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

Axis name_axis(const std::string& name, const std::string& program, const std::string& origin) {
  if (name.starts_with("model.")) return {name.substr(6), name, {}};
  std::vector<std::string> known;
  if (const auto* pattern = find_pattern(program))
    for (const auto& p : pattern->parameters) {
      if (name == p.name || name == "program." + p.name) return {p.name, "program." + p.name, {}};
      known.push_back(p.name);
    }
  for (const auto& setting : bindings()) {
    const auto last = setting.key.substr(setting.key.rfind('.') + 1);
    if (setting.key == "program.name") continue;  // one program, one set of columns
    if (name == last || name == setting.key) return {last, setting.key, {}};
    known.push_back(last);
  }
  throw BadInput(fmt::format("{}: unknown axis \"{}\" in [sweep], the nearest valid one is \"{}\"",
                             origin, name, base::nearest_name(name, known)));
}

namespace {

void bind_key(Experiment& experiment, const Place& at) {
  if (at.key.starts_with("model.")) return bind_model_entry(experiment, at);
  const auto* pattern = find_pattern(experiment.program);
  if (pattern) {
    if (at.key.starts_with("program.") && at.key != "program.name")
      return bind_parameter(experiment, *pattern, at);
    check_belongs(*pattern, at);
  }
  check_used(pattern, at);
  bind_one(experiment, bindings(), at);
}

}  // namespace

Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const std::string& origin, const std::string& folder) {
  Experiment experiment;
  experiment.program = read_program(file, origin);
  if (const auto* pattern = find_pattern(experiment.program)) {
    for (const auto& p : pattern->parameters)
      if (p.is_path)
        experiment.files[p.name] = {};
      else
        experiment.parameters[p.name] = p.value;
  }
  for_each_key(file, [&](const std::string& key, const toml::node& node) {
    bind_key(experiment, {origin, key, folder, node});
  });
  for (const auto& [key, value] : replacements) bind_key(experiment, {origin, key, folder, *value});
  return experiment;
}

}  // namespace laboratory

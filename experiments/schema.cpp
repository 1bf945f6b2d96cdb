#include "experiments/schema.hpp"

#include <algorithm>
#include <functional>

#include "experiments/image_names.hpp"
#include "experiments/values.hpp"
#include "simulator/machine/faults.hpp"
#include "topologies/spelling.hpp"

namespace experiments {

namespace {

using machine::InvalidInput;

template <class Target>
struct Binding {
  std::string key, help;
  std::function<void(Target&, const Place&)> set;
};

template <class Target>
void bind_one(Target& target, const std::vector<Binding<Target>>& bindings, const Place& at) {
  const auto found = std::ranges::find(bindings, at.key, &Binding<Target>::key);
  if (found != bindings.end()) return found->set(target, at);
  std::vector<std::string> known;
  for (const auto& b : bindings) known.push_back(b.key);
  const auto same_end = std::ranges::find_if(
      known, [&](const std::string& key) { return key.ends_with("." + at.key); });
  throw InvalidInput(
      fmt::format("{}: unknown key \"{}\", the nearest valid key is \"{}\"", at.where(), at.key,
                  same_end != known.end() ? *same_end : topologies::nearest_name(at.key, known)));
}

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
    throw InvalidInput(
        fmt::format("{}: [[order]] at {} s: expected either limits or non_interactive = true",
                    at.where(), order.at_s));
  farm::Command command;
  if (order.non_interactive)
    command.content = farm::NonInteractive{};
  else
    command.content = order.limits;
  return {{order.at_s}, command};
}

const std::vector<Binding<Experiment>>& bindings() {
  using E = Experiment;
  using P = Place;
  static const std::vector<Binding<E>> all = {
      {"title", "what the experiment is called",
       [](E& e, const P& at) { e.title = read_text(at); }},
      {"question", "what it answers", [](E& e, const P& at) { e.question = read_text(at); }},
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
      {"farm.seed", "of the order of the cells",
       [](E& e, const P& at) { e.farm.seed = std::uint64_t(read_int(at, 0, INT64_MAX)); }},
      {"run.cost", "counted: operations times their cycles",
       [](E& e, const P& at) {
         e.cost = read_name(at, Names<std::string>{{"counted", "counted"}});
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
  };
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
    return list;
  }();
  return all;
}

std::string key_of_axis(std::string_view axis, const std::string& origin) {
  std::vector<std::string> known;
  for (const auto& setting : bindings()) {
    const auto last = setting.key.substr(setting.key.rfind('.') + 1);
    if (axis == last || axis == setting.key) return setting.key;
    known.push_back(last);
  }
  throw InvalidInput(
      fmt::format("{}: unknown axis \"{}\" in [sweep], the nearest valid one is \"{}\"", origin,
                  axis, topologies::nearest_name(axis, known)));
}

Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const std::string& origin, const std::string& folder) {
  Experiment experiment;
  for (auto&& [section, content] : file) {
    const std::string name(section.str());
    if (name == "sweep") continue;
    if (!content.is_table()) {
      bind_one(experiment, bindings(), {origin, name, folder, content});
      continue;
    }
    for (auto&& [key, node] : *content.as_table())
      bind_one(experiment, bindings(),
               {origin, fmt::format("{}.{}", name, key.str()), folder, node});
  }
  for (const auto& [key, value] : replacements)
    bind_one(experiment, bindings(), {origin, key, folder, *value});
  return experiment;
}

}  // namespace experiments

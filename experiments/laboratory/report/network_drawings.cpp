#include "experiments/laboratory/report/network_drawings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <unordered_map>

#include "base/share.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "topologies/draw/layout.hpp"
#include "topologies/draw/load_drawing.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// maximum number of workers of a network that is shown in the report (2 MB of SVG)
constexpr int MAX_SHOWN = 1024;

// Shares of time that processors were busy, by name. They are limited to at most 1, because
// rounding can make them slightly larger.
using Busy = std::unordered_map<std::string, double>;

double busy(const ordered_json& of) { return std::clamp(of.at("busy").get<double>(), 0.0, 1.0); }

Busy read_cpus(const ordered_json& use) {
  Busy cpus;
  for (const auto& cpu : use.at("cpus")) cpus[cpu.at("name")] = busy(cpu);
  return cpus;
}

// Shares of time that links were busy, by "FROM>TO". If two processors have several links, their
// shares are in the order of the topology's links.
using LinkBusy = std::unordered_map<std::string, std::deque<double>>;

LinkBusy read_links(const ordered_json& use) {
  LinkBusy links;
  for (const auto& link : use.at("links"))
    links[fmt::format("{}>{}", link.at("from").get_ref<const std::string&>(),
                      link.at("to").get_ref<const std::string&>())]
        .push_back(busy(link));
  return links;
}

// Removes and returns the shares of both directions of the next link between two processors. No
// value if the record contains no further link.
std::optional<std::array<double, 2>> take_both_ways(LinkBusy& links, const std::string& a,
                                                    const std::string& b) {
  auto &there = links[a + ">" + b], &back = links[b + ">" + a];
  if (there.empty() || back.empty()) return {};
  const std::array both{there.front(), back.front()};
  there.pop_front();
  back.pop_front();
  return both;
}

// Describes a point by its network and the values of its axes: "topology = ring:3, workers = 3,
// objects = 9".
std::string make_caption(const Simulation& s, std::size_t point) {
  const auto& row = s.table.rows[s.table.row_of(point)];
  std::vector<std::string> parts;
  for (const auto& column : axis_columns(s.file))
    parts.push_back(fmt::format("{} = {}", column, to_string(row[*s.table.find(column)])));
  return join_texts(parts, ", ");
}

// The topology as drawn, with its loads.
struct LoadedNetwork {
  topologies::Topology topology;
  topologies::Loads loads;
};

LoadedNetwork load_network(topologies::Topology topology, const programs::NetworkDrawing& drawing,
                           const std::string& caption, const ordered_json& use) {
  const auto cpus = read_cpus(use);
  auto links = read_links(use);
  topologies::Loads loads;
  loads.title = caption;
  for (int id = 0; id < topology.processors; ++id) {
    loads.processors.push_back(cpus.at(drawing.name(topology, id)));
    loads.labels.push_back(name_of(topology, id, std::to_string(id + 1)));
  }
  // Drops links without recorded loads, because the program does not use them.
  std::erase_if(topology.links, [&](const topologies::Link& link) {
    const auto both = take_both_ways(links, drawing.name(topology, link.a.processor),
                                     drawing.name(topology, link.b.processor));
    if (both) loads.links.push_back(*both);
    return !both;
  });
  const auto root = drawing.name(topology, topology.root);
  for (const auto& [name, to] : drawing.outsiders)
    loads.extras.push_back(
        {name, cpus.at(name), to, take_both_ways(links, name, to.empty() ? root : to).value()});
  return {std::move(topology), std::move(loads)};
}

// Makes a file name from the values of the axes, such as "topology-tree-workers-16", or from the
// topology if there are no axes.
std::string file_name(const Point& point) {
  std::string name;
  for (const auto& at : point.at) name += "-" + at.axis + "-" + to_string(to_value(at));
  if (name.empty()) name = "-" + point.experiment.topology.text;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '-';
  return name.substr(1);
}

// For each point, true if it has the most workers among the points that differ from it only in the
// number of workers.
std::vector<bool> find_largest(const Simulation& s) {
  std::map<std::string, std::size_t> largest;
  const std::size_t column = *s.table.find(s.file.points[0].experiment.program->processors);
  const auto workers = [&](std::size_t i) {
    return as_number(s.table.rows[s.table.row_of(i)][column]).value_or(0);
  };
  for (std::size_t i = 0; i < s.file.points.size(); ++i) {
    std::string key;
    for (const auto& at : s.file.points[i].at)
      if (at.axis != "workers") key += at.axis + base::to_toml(*at.value) + "\n";
    const auto [known, added] = largest.emplace(key, i);
    if (!added && workers(i) > workers(known->second)) known->second = i;
  }
  std::vector<bool> is_largest(s.file.points.size());
  for (const auto& [key, i] : largest) is_largest[i] = true;
  return is_largest;
}

fs::path drawing_of(const Point& point) {
  return fs::path("networks") / (file_name(point) + ".svg");
}

// A network that several points use, or the reason why it could not be made.
struct Network {
  std::size_t point;  // one of the points that use the network
  topologies::Topology topology = {};
  std::string failure = {};
};

// The drawing of a point, or the reason why it could not be made.
struct Drawn {
  std::size_t point;
  const Network* network;
  std::string svg = {}, failure = {};
};

void draw_point(const fs::path& folder, const Simulation& s, Drawn& drawn) try {
  drawn.failure = drawn.network->failure;
  const auto& topology = drawn.network->topology;
  if (!drawn.failure.empty() || topology.processors > topologies::MAX_DRAWN) return;
  const auto use = load_record(folder / s.records[drawn.point]).use;
  const auto network =
      load_network(topology, *shows_of(s.file).network, make_caption(s, drawn.point), use);
  drawn.svg = to_load_svg(network.topology, network.loads);
  const auto& point = s.file.points[drawn.point];
  base::save_whole(folder / drawing_of(point), drawn.svg);
  if (const auto style = s.file.report.figure.make_style({}); style.is_figure())
    save_figure(folder / "figures", "network-" + file_name(point),
                to_load_svg(network.topology, network.loads, style));
} catch (const std::exception& error) {
  drawn.failure = describe_error(error);
}

// Calls f for each element. Up to RunOptions::jobs threads share this work.
template <class Thing, class F>
void share(const RunOptions& options, std::vector<Thing>& things, const F& f) {
  base::share(static_cast<int>(things.size()), static_cast<int>(options.jobs),
              [&](int n) { f(things[static_cast<std::size_t>(n)]); });
}

}  // namespace

NetworkDrawings draw_networks(const fs::path& folder, const RunOptions& options,
                              const Simulation& s) {
  NetworkDrawings networks;
  if (s.file.report.networks == "none" || !shows_of(s.file).network) return networks;
  const auto is_largest = find_largest(s);
  make_folders(folder / "networks");
  if (s.file.report.figure.make_style({}).is_figure()) make_folders(folder / "figures");
  std::map<std::string, std::size_t> known;  // index of each network in `made`, by network_key
  std::vector<Network> made;
  // points to draw, each with the index of its network in `made`
  std::vector<std::pair<std::size_t, std::size_t>> asked;
  for (std::size_t i = 0; i < s.file.points.size(); ++i) {
    if (!s.results[i].is_complete() || (s.file.report.networks == "largest" && !is_largest[i]))
      continue;
    const auto [network, is_new] =
        known.emplace(network_key(s.file.points[i].experiment), made.size());
    if (is_new) made.push_back({i});
    asked.emplace_back(i, network->second);
  }
  share(options, made, [&](Network& network) {
    try {
      network.topology = make_workers(s.file.points[network.point].experiment);
    } catch (const std::exception& error) {
      network.failure = describe_error(error);
    }
  });
  std::vector<Drawn> drawn;
  for (const auto& [point, network] : asked) drawn.push_back({point, &made[network]});
  share(options, drawn, [&](Drawn& one) {
    draw_point(folder, s, one);
    if (!is_largest[one.point]) one.svg.clear();
  });
  for (auto& [i, network, svg, failure] : drawn) {
    const Point& point = s.file.points[i];
    const int workers = network->topology.processors;
    if (!failure.empty())
      networks.failures.push_back(fmt::format("network at {}: {}", name_of(point), failure));
    else if (workers > topologies::MAX_DRAWN)
      networks.notes.push_back(fmt::format(
          "not drawn: the network at {} with {} workers, because a drawing has at most {}",
          name_of(point), workers, topologies::MAX_DRAWN));
    else if (is_largest[i] && workers > MAX_SHOWN)
      networks.notes.push_back(fmt::format(
          "the network at {} is drawn only in {}: found {} workers, this page shows at most {}",
          name_of(point), drawing_of(point).string(), workers, MAX_SHOWN));
    else if (is_largest[i])
      networks.drawings.push_back({make_caption(s, i), std::move(svg)});
  }
  return networks;
}

}  // namespace laboratory

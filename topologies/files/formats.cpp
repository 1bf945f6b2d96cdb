#include "topologies/files/formats.hpp"

#include <fmt/format.h>

#include "base/whole_file.hpp"
#include "topologies/graph/metrics.hpp"
#include "topologies/route/route_load.hpp"
#include "topologies/route/up_down.hpp"

namespace topologies {
namespace {

std::string format_busiest(const Topology& topology, const BusiestLink& link) {
  if (link.from < 0) return "none";
  return fmt::format("{} messages, {} to {}", link.messages,
                     describe_processor(topology, link.from),
                     describe_processor(topology, link.to));
}

std::string format_metrics(const Topology& topology, const Metrics& m) {
  const auto bisection = m.bisection_width ? fmt::format("{}", *m.bisection_width) : "unknown";
  const auto degree = m.degree_min == m.degree_max
                          ? fmt::format("{}", m.degree_min)
                          : fmt::format("{} to {}", m.degree_min, m.degree_max);
  std::string text;
  const auto row = [&](std::string_view name, const auto& value) {
    text += fmt::format("{:<24}{}\n", name, value);
  };
  row("topology", topology.name);
  row("processors", m.processors);
  row("root", describe_processor(topology, topology.root));
  row("links", m.links);
  if (topology.has_arrows) row("arrows", "read as links in both directions");
  if (topology.has_port_names)
    row("port names", "ignored, because they are not numbers from 0 to 3");
  row("links per processor", degree);
  row("diameter", m.diameter);
  row("mean distance", fmt::format("{:.4f}", m.mean_distance));
  row("bisection width", bisection);
  row("busiest, farm", format_busiest(topology, m.farm));
  row("busiest, all to all", format_busiest(topology, m.all_to_all));
  return text;
}

}  // namespace

Topology load_topology(const std::string& path) {
  const auto text = base::read_text(path, MAX_FILE_BYTES);
  return path.ends_with(".graphml") ? read_graphml(text, path) : read_dot(text, path);
}

std::string to_csv(const Topology& topology) {
  std::string text = "processor_a,port_a,processor_b,port_b\n";
  for (const auto& [a, b] : topology.links)
    text += fmt::format("{},{},{},{}\n", a.processor, a.port, b.processor, b.port);
  return text;
}

std::string to_metrics(const Topology& topology) {
  return format_metrics(topology, eval_metrics(topology));
}

std::string to_metrics(const Topology& topology, const RoutingTable& routes) {
  auto metrics = eval_metrics(topology);
  metrics.mean_distance = routes.mean_distance();
  metrics.all_to_all = find_busiest(topology, eval_load(topology, routes));
  const bool closes = closes_cycle(topology, routes, {});
  return format_metrics(topology, metrics) +
         fmt::format("{:<24}{}\n", "routes close a cycle", closes ? "yes" : "no");
}

}  // namespace topologies

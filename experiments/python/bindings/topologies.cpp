#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <tuple>

#include "base/errors.hpp"
#include "experiments/python/bindings/bindings.hpp"
#include "topologies/draw/drawing.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/files/raw_graph.hpp"
#include "topologies/graph/metrics.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/given_routes.hpp"
#include "topologies/route/route_load.hpp"
#include "topologies/route/up_down.hpp"

namespace py = pybind11;
using pybind11::literals::operator""_a;

namespace bindings {
namespace {

using topologies::RoutingTable;
using topologies::Topology;

// A link: its two processors, then their ports.
using Wire = std::tuple<int, int, int, int>;

// An edge of a graph: its two vertices, by index into the list of names, and the texts of its
// attributes port_a, port_b, tailport and headport. "" stands for a missing attribute.
using Edge = std::tuple<int, int, std::string, std::string, std::string, std::string>;

// Makes the topology of a graph by the same rules as for graph files. `roots` has the text of each
// vertex's attribute "root"; `root` is the text of the graph's attribute "root".
Topology make_graph(const std::string& name, const std::vector<std::string>& names,
                    const std::vector<std::string>& roots, const std::string& root,
                    const std::vector<Edge>& edges, bool has_arrows) {
  topologies::RawGraph graph;
  graph.has_arrows = has_arrows;
  graph.root = root;
  for (std::size_t i = 0; i < names.size(); ++i) graph.vertices.push_back({names[i], roots.at(i)});
  const auto is_vertex = [&](int v) { return v >= 0 && v < static_cast<int>(names.size()); };
  for (const auto& [from, to, port_a, port_b, tailport, headport] : edges) {
    base::require(is_vertex(from) && is_vertex(to), name, "an edge ends at no vertex");
    graph.edges.push_back({from, to, port_a, port_b, tailport, headport});
  }
  return topologies::make_topology(graph, name);
}

// Lists the links: the lower and the higher processor, then their ports.
std::vector<Wire> list_links(const Topology& topology) {
  std::vector<Wire> links;
  for (const auto& [a, b] : topology.links)
    links.emplace_back(a.processor, b.processor, a.port, b.port);
  return links;
}

py::object find_link(const topologies::BusiestLink& busiest) {
  if (busiest.from < 0) return py::none();
  return py::make_tuple(busiest.from, busiest.to);
}

py::dict measure(const Topology& topology) {
  const auto m = topologies::eval_metrics(topology);
  return py::dict("processors"_a = m.processors, "links"_a = m.links, "degree_min"_a = m.degree_min,
                  "degree_max"_a = m.degree_max, "diameter"_a = m.diameter,
                  "mean_distance"_a = m.mean_distance, "bisection_width"_a = m.bisection_width,
                  "farm_messages"_a = m.farm.messages, "farm_link"_a = find_link(m.farm),
                  "all_to_all_messages"_a = m.all_to_all.messages,
                  "all_to_all_link"_a = find_link(m.all_to_all));
}

// A routing table, with the topology that it was made for.
struct Routes {
  Topology topology;
  RoutingTable table;

  void check(int processor) const {
    base::require(processor >= 0 && processor < table.processors, topology.name,
                  "found processor {}, expected 0 to {}", processor, table.processors - 1);
  }
  int distance(int from, int to) const {
    check(from), check(to);
    return from == to ? 0 : table.distance(from, to);
  }
  // The processors on the route from `from` to `to`, including both.
  std::vector<int> path(int from, int to) const {
    check(from), check(to);
    std::vector<int> processors{from};
    while (from != to) {
      from = table.rule->peers()[static_cast<std::size_t>(from)]
                                [static_cast<std::size_t>(table.next_port(from, to))];
      processors.push_back(from);
    }
    return processors;
  }
  py::array_t<int> distances() const {
    const int n = table.processors;
    py::array_t<int> all({n, n});
    auto at = all.mutable_unchecked<2>();
    for (int to = 0; to < n; ++to)
      for (int from = 0; from < n; ++from) at(from, to) = distance(from, to);
    return all;
  }
  py::tuple busiest() const {
    const auto found = topologies::find_busiest(topology, topologies::eval_load(topology, table));
    return py::make_tuple(find_link(found), found.messages);
  }
  bool closes_cycle() const { return topologies::closes_cycle(topology, table, {}); }
};

Routes make_routes(const Topology& topology, const std::string& name) {
  return {topology, topologies::find_routes(topology, name)};
}

}  // namespace

void bind_topologies(py::module_& module) {
  py::class_<Topology>(module, "Topology")
      .def_readonly("name", &Topology::name)
      .def_readonly("processors", &Topology::processors)
      .def_readonly("root", &Topology::root)
      .def_readonly("labels", &Topology::labels)
      .def_readonly("has_arrows", &Topology::has_arrows)
      .def("links", &list_links)
      .def("metrics", &measure)
      .def("to_dot", &topologies::to_dot)
      .def("to_graphml", &topologies::to_graphml)
      .def("to_svg", [](const Topology& topology) { return topologies::to_svg(topology); });
  py::class_<Routes>(module, "Routes")
      .def("distance", &Routes::distance)
      .def("path", &Routes::path)
      .def("distances", &Routes::distances)
      .def("mean_distance", [](const Routes& r) { return r.table.mean_distance(); })
      .def("busiest", &Routes::busiest)
      .def("closes_cycle", &Routes::closes_cycle);
  module.def("make_topology", [](const std::string& s) { return topologies::make_topology(s); });
  module.def("make_graph", &make_graph);
  module.def("make_routes", &make_routes);
  module.def("generators", [] {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& generator : topologies::generators())
      all.emplace_back(generator.form, generator.help);
    return all;
  });
}

}  // namespace bindings

// DOT and GraphML by Boost.Graph's writers.
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graphml.hpp>
#include <boost/graph/graphviz.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <sstream>

#include "topologies/files/formats.hpp"

namespace topologies {
namespace {

struct Edge {
  int port_a, port_b;
};

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS,
                                    boost::no_property, Edge, std::string>;

std::string name_of(const Topology& topology, size_t processor) {
  return topology.labels.empty() ? std::to_string(processor) : topology.labels[processor];
}

Graph make_graph(const Topology& topology) {
  Graph graph(topology.processors);
  for (const auto& [a, b] : topology.links)
    add_edge(a.processor, b.processor, Edge{a.port, b.port}, graph);
  get_property(graph) = name_of(topology, topology.root);
  return graph;
}

}  // namespace

std::string to_dot(const Topology& topology) {
  const Graph graph = make_graph(topology);
  std::vector<std::string> names;
  for (int p = 0; p < topology.processors; ++p) names.push_back(name_of(topology, p));
  const auto write_graph = [&](std::ostream& out) {
    out << "label=" << boost::escape_dot_string(topology.name)
        << ";\nroot=" << boost::escape_dot_string(get_property(graph))
        << ";\nnode [shape=circle];\nedge [fontsize=8];\n";
  };
  const auto write_vertex = [&](std::ostream& out, auto v) {
    if (static_cast<int>(v) == topology.root) out << " [peripheries=2]";
  };
  const auto write_edge = [&](std::ostream& out, auto e) {
    const auto [a, b] = graph[e];
    out << " [port_a=" << a << ", port_b=" << b << ", taillabel=" << a << ", headlabel=" << b
        << "]";
  };
  std::ostringstream out;
  boost::write_graphviz(
      out, graph, write_vertex, write_edge, write_graph,
      boost::make_iterator_property_map(names.begin(), get(boost::vertex_index, graph)));
  return out.str();
}

std::string to_graphml(const Topology& topology) {
  Graph graph = make_graph(topology);
  boost::dynamic_properties properties;
  boost::ref_property_map<Graph*, std::string> root(get_property(graph));
  const auto name = boost::make_function_property_map<size_t>(
      [&](size_t processor) { return name_of(topology, processor); });
  properties.property("root", root);
  properties.property("name", name);
  properties.property("port_a", get(&Edge::port_a, graph));
  properties.property("port_b", get(&Edge::port_b, graph));
  std::ostringstream out;
  boost::write_graphml(out, graph, properties, true);
  return out.str();
}

}  // namespace topologies

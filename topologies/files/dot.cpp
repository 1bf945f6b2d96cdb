#include "topologies/files/dot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graphviz.hpp>
#include <numeric>
#include <sstream>

#include "base/errors.hpp"
#include "topologies/files/dot_text.hpp"
#include "topologies/files/raw_graph.hpp"

namespace topologies {
namespace {

struct Edge {
  std::string port_a, port_b, tailport, headport;
};

// Our attribute, or Graphviz's where it is a number and not a compass point of the drawing.
std::string choose_port(const std::string& ours, const std::string& graphviz) {
  const bool is_number =
      !graphviz.empty() && graphviz.find_first_not_of("0123456789") == std::string::npos;
  return ours.empty() && is_number ? graphviz : ours;
}

template <typename Directedness>
RawGraph read_raw(const std::string& text) {
  using Graph =
      boost::adjacency_list<boost::vecS, boost::vecS, Directedness, RawVertex, Edge, std::string>;
  Graph graph;
  boost::dynamic_properties properties(boost::ignore_other_properties);
  boost::ref_property_map<Graph*, std::string> root(get_property(graph));
  properties.property("root", root);
  properties.property("root", get(&RawVertex::root, graph));
  properties.property("node_id", get(&RawVertex::name, graph));
  properties.property("port_a", get(&Edge::port_a, graph));
  properties.property("port_b", get(&Edge::port_b, graph));
  properties.property("tailport", get(&Edge::tailport, graph));
  properties.property("headport", get(&Edge::headport, graph));
  boost::read_graphviz(text, graph, properties);

  RawGraph raw;
  raw.root = get_property(graph);
  for (auto [v, end] = vertices(graph); v != end; ++v) raw.vertices.push_back(graph[*v]);
  for (auto [e, end] = edges(graph); e != end; ++e)
    raw.edges.push_back({static_cast<int>(source(*e, graph)), static_cast<int>(target(*e, graph)),
                         choose_port(graph[*e].port_a, graph[*e].tailport),
                         choose_port(graph[*e].port_b, graph[*e].headport)});
  return raw;
}

// Puts the vertices, which the reader sorts by name, in the order in which the file names them.
void restore_order(RawGraph& raw, const std::map<std::string, int>& place) {
  std::vector<int> order(raw.vertices.size()), now(raw.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int v) {
    const auto found = place.find(raw.vertices[v].name);
    return found == place.end() ? static_cast<int>(place.size()) : found->second;
  });
  std::vector<RawVertex> sorted;
  for (const int v : order) {
    now[v] = static_cast<int>(sorted.size());
    sorted.push_back(raw.vertices[v]);
  }
  raw.vertices = std::move(sorted);
  for (auto& edge : raw.edges) edge.source = now[edge.source], edge.target = now[edge.target];
}

RawGraph read_raw(const std::string& text, const std::string& name) {
  try {
    try {
      return read_raw<boost::undirectedS>(text);
    } catch (const boost::directed_graph_error&) {
      return read_raw<boost::directedS>(text);
    }
  } catch (const std::exception& error) {
    throw base::BadInput(fmt::format("{}: malformed DOT: {}", name, error.what()));
  }
}

}  // namespace

Topology read_dot(const std::string& text, const std::string& name) {
  const auto dot = make_dot_text(text, name);
  auto raw = read_raw(dot.text, name);
  restore_order(raw, dot.place);
  return make_topology(raw, name);
}

std::string to_dot(const Topology& topology) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property, Link>
      graph(topology.processors);
  for (const auto& link : topology.links) add_edge(link.a.processor, link.b.processor, link, graph);
  auto names = names_of(topology);
  const auto write_graph = [&](std::ostream& out) {
    out << "label=" << boost::escape_dot_string(topology.name)
        << ";\nroot=" << boost::escape_dot_string(names[topology.root])
        << ";\nnode [shape=circle];\nedge [fontsize=8];\n";
  };
  const auto write_vertex = [&](std::ostream& out, auto v) {
    if (static_cast<int>(v) == topology.root) out << " [peripheries=2]";
  };
  const auto write_edge = [&](std::ostream& out, auto e) {
    const auto [a, b] = graph[e];
    out << fmt::format(" [port_a={0}, port_b={1}, taillabel={0}, headlabel={1}]", a.port, b.port);
  };
  std::ostringstream out;
  boost::write_graphviz(
      out, graph, write_vertex, write_edge, write_graph,
      boost::make_iterator_property_map(names.begin(), get(boost::vertex_index, graph)));
  return out.str();
}

}  // namespace topologies

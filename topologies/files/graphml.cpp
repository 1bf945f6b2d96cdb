#include "topologies/files/graphml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <ranges>
#include <set>
#include <tuple>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "topologies/files/raw_graph.hpp"
#include "topologies/files/xml.hpp"

namespace topologies {
namespace {

constexpr int DEPTH = 4;  // levels of elements: graphml, graph, node, data

// Child elements that tlab reads, by the parent's name. tlab ignores other children. Elements in
// PARTS, such as graphs, hyperedges and links to other files, are an error in any place not listed
// here.
const std::map<std::string, std::set<std::string>> KNOWN{
    {"graphml", {"key", "graph"}}, {"graph", {"node", "edge"}}, {"node", {"port"}}, {"edge", {}}};
const std::set<std::string> PARTS{"graph", "node", "edge", "hyperedge", "locator"};

// Reads one GraphML file.
class GraphmlReader {
 public:
  GraphmlReader(const XmlElement& graphml, std::string file);

  RawGraph read();

 private:
  struct Key {
    std::string domain, name, standard;
  };

  [[nodiscard]] std::string place_of(const XmlElement& element) const {
    return fmt::format("{}: line {}", file_, element.line);
  }
  // The child elements named `name` in GraphML's XML namespace.
  auto children(const XmlElement& element, std::string_view name) const {
    return element.children | std::views::filter([this, name](const XmlElement& child) {
             return child.name == name && child.space == graphml_.space;
           });
  }
  void refuse_other_parts(const XmlElement& element) const;
  std::string require_attribute(const XmlElement& element, const char* key) const;
  std::string find(const XmlElement& element, const char* name) const;
  void read_key(const XmlElement& key);
  void read_node(const XmlElement& node);
  void read_edge(const XmlElement& edge, bool is_directed);
  int find_vertex(const XmlElement& edge, const char* end) const;

  const XmlElement& graphml_;
  std::string file_;
  std::map<std::string, Key> keys_;      // the file's keys, by id
  std::map<std::string, int> vertices_;  // numbers of the vertices, by id
  std::set<std::string> names_;
  // Source, target and id of the edges that have an id.
  std::set<std::tuple<int, int, std::string>> edges_;
  RawGraph raw_;
};

GraphmlReader::GraphmlReader(const XmlElement& graphml, std::string file)
    : graphml_(graphml), file_(std::move(file)) {
  base::require(graphml.name == "graphml", place_of(graphml), "found <{}>, expected <graphml>",
                graphml.name);
}

// Refuses child elements of PARTS in places that KNOWN does not list: a second or nested graph,
// hyperedges, and graphs in other files.
void GraphmlReader::refuse_other_parts(const XmlElement& element) const {
  const auto& known = KNOWN.at(element.name);
  for (const auto& child : element.children)
    if (child.space == graphml_.space && PARTS.contains(child.name) && !known.contains(child.name))
      base::refuse(place_of(child), "found <{}> in <{}>, expected one graph of nodes and edges",
                   child.name, element.name);
}

std::string GraphmlReader::require_attribute(const XmlElement& element, const char* key) const {
  const auto value = element.attribute(key);
  base::require(!value.empty(), place_of(element), "found <{}> without the attribute \"{}\"",
                element.name, key);
  return value;
}

void GraphmlReader::read_key(const XmlElement& key) {
  const auto id = require_attribute(key, "id");
  std::string standard;
  for (const auto& element : children(key, "default")) standard = element.text;
  const auto domain = key.attribute("for");
  const bool is_new = keys_
                          .try_emplace(id, Key{domain.empty() ? "all" : domain,
                                               key.attribute("attr.name"), standard})
                          .second;
  base::require(is_new, place_of(key), "found two keys with the id \"{}\", expected different ids",
                id);
}

// The value of the element's attribute `name`, or the attribute's default value; "" if there is
// neither.
std::string GraphmlReader::find(const XmlElement& element, const char* name) const {
  std::string value;
  for (const auto& [id, key] : keys_)
    if (key.name == name && (key.domain == element.name || key.domain == "all"))
      value = key.standard;
  for (const auto& data : children(element, "data")) {
    const auto id = require_attribute(data, "key");
    const auto key = keys_.find(id);
    base::require(key != keys_.end(), place_of(data),
                  "found data of \"{}\", expected the id of a key", id);
    if (key->second.name == name && !data.text.empty()) value = data.text;
  }
  return value;
}

void GraphmlReader::read_node(const XmlElement& node) {
  refuse_other_parts(node);
  const auto id = require_attribute(node, "id"), name = find(node, "name");
  base::require(vertices_.emplace(id, vertices_.size()).second, place_of(node),
                "found two nodes with the id \"{}\", expected different ids", id);
  raw_.vertices.push_back({name.empty() ? id : name, find(node, "root"), node.line});
  base::require(names_.insert(raw_.vertices.back().name).second, place_of(node),
                "found two vertices called \"{}\", expected different names",
                raw_.vertices.back().name);
}

int GraphmlReader::find_vertex(const XmlElement& edge, const char* end) const {
  const auto id = require_attribute(edge, end);
  const auto found = vertices_.find(id);
  base::require(found != vertices_.end(), place_of(edge),
                "found an edge whose {} is \"{}\", expected the id of a node", end, id);
  return found->second;
}

void GraphmlReader::read_edge(const XmlElement& edge, bool is_directed) {
  refuse_other_parts(edge);
  if (const auto text = edge.attribute("directed"); !text.empty())
    is_directed = text == "true" || text == "1";
  raw_.has_arrows |= is_directed;
  const int source = find_vertex(edge, "source"), target = find_vertex(edge, "target");
  const auto id = edge.attribute("id");
  const auto [low, high] = std::minmax(source, target);
  const auto ends = is_directed ? std::tuple(source, target, id) : std::tuple(low, high, id);
  base::require(id.empty() || edges_.insert(ends).second, place_of(edge),
                "found two edges between the same nodes with the id \"{}\", expected different ids",
                id);
  const auto find_name = [&](const char* port, const char* graphviz) {
    const auto name = edge.attribute(port);
    return name.empty() ? find(edge, graphviz) : name;
  };
  raw_.edges.push_back({source, target, find(edge, "port_a"), find(edge, "port_b"),
                        find_name("sourceport", "tailport"), find_name("targetport", "headport"),
                        edge.line});
}

RawGraph GraphmlReader::read() {
  refuse_other_parts(graphml_);
  for (const auto& key : children(graphml_, "key")) read_key(key);
  const XmlElement* graph = nullptr;
  for (const auto& element : children(graphml_, "graph")) {
    base::require(graph == nullptr, place_of(element), "found a second graph, expected one");
    graph = &element;
  }
  base::require(graph != nullptr, place_of(graphml_),
                "found no <graph> in <graphml>, expected one");
  refuse_other_parts(*graph);
  for (const auto& node : children(*graph, "node")) read_node(node);
  const bool is_directed = graph->attribute("edgedefault") == "directed";
  for (const auto& edge : children(*graph, "edge")) read_edge(edge, is_directed);
  // The graph's attribute `root` may hold the name or the id of a vertex.
  raw_.root = find(*graph, "root");
  const auto by_id = vertices_.find(raw_.root);
  if (!names_.contains(raw_.root) && by_id != vertices_.end())
    raw_.root = raw_.vertices[static_cast<std::size_t>(by_id->second)].name;
  return std::move(raw_);
}

}  // namespace

Topology read_graphml(const std::string& text, const std::string& name) {
  const auto graphml = read_xml(text, DEPTH, name);
  return make_topology(GraphmlReader(graphml, name).read(), name);
}

std::string to_graphml(const Topology& topology) {
  const auto names = names_of(topology);
  std::string text = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://graphml.graphdrawing.org/xmlns http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd">
  <key id="key0" for="node" attr.name="name" attr.type="string" />
  <key id="key1" for="edge" attr.name="port_a" attr.type="int" />
  <key id="key2" for="edge" attr.name="port_b" attr.type="int" />
  <key id="key3" for="graph" attr.name="root" attr.type="string" />
  <graph id="G" edgedefault="undirected" parse.nodeids="canonical" parse.edgeids="canonical" parse.order="nodesfirst">
   <data key="key3">{}</data>
)",
      base::escape_xml(names[topology.root]));
  for (size_t p = 0; p < names.size(); ++p)
    text += fmt::format("    <node id=\"n{}\">\n      <data key=\"key0\">{}</data>\n    </node>\n",
                        p, base::escape_xml(names[p]));
  for (size_t i = 0; i < topology.links.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    text += fmt::format(
        "    <edge id=\"e{}\" source=\"n{}\" target=\"n{}\">\n      <data key=\"key1\">{}</data>\n"
        "      <data key=\"key2\">{}</data>\n    </edge>\n",
        i, a.processor, b.processor, a.port, b.port);
  }
  return text + "  </graph>\n</graphml>\n";
}

}  // namespace topologies

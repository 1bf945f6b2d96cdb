#include "topologies/files/graphml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "topologies/files/raw_graph.hpp"

namespace topologies {
namespace {

// The attributes declared by a GraphML file for its graph, nodes and edges.
class Attributes {
 public:
  explicit Attributes(const pugi::xml_node& graphml) {
    for (const auto& key : graphml.children("key"))
      keys_.push_back({key.attribute("id").value(), key.attribute("for").value(),
                       key.attribute("attr.name").value(), key.child("default").child_value()});
  }

  // The value of the first declared attribute with one of these names; "" if there is none.
  std::string find(const pugi::xml_node& element,
                   std::initializer_list<std::string_view> names) const {
    for (const auto& key : keys_) {
      if (std::ranges::find(names, key.name) == names.end()) continue;
      if (key.domain != element.name() && key.domain != "all") continue;
      const auto data = element.find_child_by_attribute("data", "key", key.id.c_str());
      const std::string value = data ? data.child_value() : key.standard;
      if (!value.empty()) return value;
    }
    return "";
  }

 private:
  struct Key {
    std::string id, domain, name, standard;
  };
  std::vector<Key> keys_;
};

std::string require_attribute(const pugi::xml_node& element, const char* key,
                              const std::string& file) {
  const auto attribute = element.attribute(key);
  base::require(!attribute.empty(), file, "an element without attribute \"{}\"", key);
  return attribute.value();
}

RawGraph read_raw(const pugi::xml_node& graph, const Attributes& attributes,
                  const std::string& file) {
  RawGraph raw;
  std::map<std::string, int> vertices;  // by GraphML id
  std::set<std::string> names;
  for (const auto& node : graph.children("node")) {
    const auto id = require_attribute(node, "id", file);
    base::require(!node.child("graph"), file, "a graph inside node \"{}\", expected one graph", id);
    base::require(vertices.emplace(id, vertices.size()).second, file, "two nodes have id \"{}\"",
                  id);
    const auto name = attributes.find(node, {"name"});
    raw.vertices.push_back({name.empty() ? id : name, attributes.find(node, {"root"})});
    base::require(names.insert(raw.vertices.back().name).second, file,
                  "two vertices are called \"{}\"", raw.vertices.back().name);
  }
  const bool points = std::string_view(graph.attribute("edgedefault").value()) == "directed";
  for (const auto& edge : graph.children("edge")) {
    raw.has_arrows |= edge.attribute("directed").as_bool(points);
    const auto find_vertex = [&](const char* key) {
      const auto id = require_attribute(edge, key, file);
      const auto found = vertices.find(id);
      base::require(found != vertices.end(), file, "an edge's {} is \"{}\", which is no node's id",
                    key, id);
      return found->second;
    };
    raw.edges.push_back({find_vertex("source"), find_vertex("target"),
                         attributes.find(edge, {"port_a", "tailport"}),
                         attributes.find(edge, {"port_b", "headport"})});
  }
  // The graph's attribute `root` may hold a name or an id.
  raw.root = attributes.find(graph, {"root"});
  const auto by_id = vertices.find(raw.root);
  if (!names.contains(raw.root) && by_id != vertices.end())
    raw.root = raw.vertices[by_id->second].name;
  return raw;
}

}  // namespace

Topology read_graphml(const std::string& text, const std::string& name) {
  pugi::xml_document document;
  const auto parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_trim_pcdata);
  if (!parsed) {
    const auto before = std::string_view(text).substr(0, static_cast<size_t>(parsed.offset));
    throw base::BadInput(fmt::format("{}: malformed GraphML, line {}: {}", name,
                                     1 + std::ranges::count(before, '\n'), parsed.description()));
  }
  const auto graphml = document.child("graphml"), graph = graphml.child("graph");
  base::require(!graph.empty(), name,
                "malformed GraphML: no element <graph> in an element <graphml>");
  return make_topology(read_raw(graph, Attributes(graphml), name), name);
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

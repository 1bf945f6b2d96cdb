// GraphML by Boost.Graph's read_graphml. It does not tell vertices' ids, nor edges whose vertices
// were never declared: those come from the XML itself.
#include <fmt/format.h>

#include <boost/graph/graphml.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <map>
#include <set>
#include <sstream>

#include "topologies/files/formats.hpp"
#include "topologies/files/raw_graph.hpp"

namespace topologies {
namespace {

namespace xml = boost::property_tree;

constexpr int MAX_NESTING = 200;  // the parser recurses

// What read_graphml builds: takes every value as text, whatever the declared type.
class Builder : public boost::mutate_graph {
 public:
  Builder(RawGraph& graph, bool directed) : graph_(graph), directed_(directed) {}
  bool is_directed() const override { return directed_; }
  boost::any do_add_vertex() override { return vertices_++; }
  std::pair<boost::any, bool> do_add_edge(boost::any source, boost::any target) override {
    graph_.edges.push_back({boost::any_cast<int>(source), boost::any_cast<int>(target), {}, {}});
    return {static_cast<int>(graph_.edges.size()) - 1, true};
  }
  void set_graph_property(const std::string& name, const std::string& value,
                          const std::string&) override {
    if (name == "root") graph_.root = value;
  }
  void set_vertex_property(const std::string& name, boost::any vertex, const std::string& value,
                           const std::string&) override {
    auto& raw = graph_.vertices.at(boost::any_cast<int>(vertex));
    if (name == "root") raw.root = value;
    if (name == "name" && !value.empty()) raw.name = value;
  }
  void set_edge_property(const std::string& name, boost::any edge, const std::string& value,
                         const std::string&) override {
    auto& raw = graph_.edges.at(boost::any_cast<int>(edge));
    if (name == "port_a" || name == "tailport") raw.port_a = value;
    if (name == "port_b" || name == "headport") raw.port_b = value;
  }

 private:
  RawGraph& graph_;
  bool directed_;
  int vertices_ = 0;
};

void check_nesting(const std::string& text, const std::string& name) {
  int depth = 0;
  bool in_tag = false;
  for (size_t i = 0; i + 1 < text.size(); ++i) {
    const char c = text[i], next = text[i + 1];
    if (c == '<' && !in_tag) depth += next == '/' ? -1 : next != '!' && next != '?';
    if (c == '/' && next == '>' && in_tag) --depth;
    if (c == '<' || c == '>') in_tag = c == '<';
    if (depth > MAX_NESTING)
      fail_reading(name, fmt::format("more than {} nested elements", MAX_NESTING));
  }
}

xml::ptree read_tree(const std::string& text, const std::string& name) {
  try {
    std::istringstream in(text);
    xml::ptree tree;
    xml::read_xml(in, tree, xml::xml_parser::no_comments | xml::xml_parser::trim_whitespace);
    return tree;
  } catch (const xml::xml_parser_error& error) {
    fail_reading(name,
                 fmt::format("malformed GraphML, line {}: {}", error.line(), error.message()));
  }
}

// Names the vertices by their ids, and checks that edges join declared ones.
void read_vertices(const xml::ptree& tree, const std::string& name, RawGraph& graph) {
  std::map<std::string, int> known;
  const auto attribute = [&](const xml::ptree& element, const std::string& key) {
    const auto value = element.get_optional<std::string>("<xmlattr>." + key);
    if (!value) fail_reading(name, fmt::format("an element without attribute \"{}\"", key));
    return *value;
  };
  for (const auto& [tag, element] : tree) {
    if (tag != "node") continue;
    graph.vertices.push_back({attribute(element, "id"), {}});
    if (!known.emplace(graph.vertices.back().name, known.size()).second)
      fail_reading(name, fmt::format("two nodes have id \"{}\"", graph.vertices.back().name));
  }
  for (const auto& [tag, element] : tree) {
    if (tag != "edge") continue;
    for (const auto* key : {"source", "target"})
      if (const auto id = attribute(element, key); !known.contains(id))
        fail_reading(name, fmt::format("an edge's {} is \"{}\", which is no node's id", key, id));
  }
}

// Attribute `name` may have replaced ids: the root may be given by either.
void settle_names(const std::vector<RawVertex>& ids, const std::string& name, RawGraph& graph) {
  std::set<std::string> names;
  for (const auto& vertex : graph.vertices)
    if (!names.insert(vertex.name).second)
      fail_reading(name, fmt::format("two vertices are called \"{}\"", vertex.name));
  if (names.contains(graph.root)) return;
  for (size_t v = 0; v < ids.size(); ++v)
    if (ids[v].name == graph.root) graph.root = graph.vertices[v].name;
}

}  // namespace

Topology read_graphml(const std::string& text, const std::string& name) {
  check_nesting(text, name);
  const auto tree = read_tree(text, name);
  const auto graph = tree.get_child_optional("graphml.graph");
  if (!graph) fail_reading(name, "malformed GraphML: no element <graph> in an element <graphml>");
  RawGraph raw;
  read_vertices(*graph, name, raw);
  const auto ids = raw.vertices;
  const bool directed = graph->get("<xmlattr>.edgedefault", "undirected") == "directed";
  try {
    std::istringstream in(text);
    Builder builder(raw, directed);
    boost::read_graphml(in, builder, 0);
  } catch (const std::exception& error) {
    fail_reading(name, fmt::format("malformed GraphML: {}", error.what()));
  }
  settle_names(ids, name, raw);
  return make_topology(raw, name);
}

}  // namespace topologies

#include "topologies/files/dot_graph.hpp"

#include <initializer_list>

namespace topologies {
namespace {

constexpr auto EDGE_ATTRIBUTES = {"port_a", "port_b", "tailport", "headport"};

// Copies only the attributes whose names are in `known`.
void copy_known(const DotAttributes& from, std::initializer_list<const char*> known,
                DotAttributes& to) {
  for (const auto* name : known)
    if (const auto found = from.find(name); found != from.end()) to[name] = found->second;
}

std::string find_text(const DotAttributes& attributes, const char* name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

}  // namespace

int DotGraph::open_group(int around, const std::optional<std::string>& name) {
  const auto fresh = static_cast<int>(groups_.size());
  if (name) {
    const auto [place, is_new] = groups_[index(around)].groups.try_emplace(*name, fresh);
    if (!is_new) return place->second;
  }
  groups_.push_back({around});
  return fresh;
}

std::string DotGraph::find_default(int group, DotAttributes Group::*defaults,
                                   const std::string& name) const {
  for (; group >= 0; group = groups_[index(group)].around) {
    const auto& here = groups_[index(group)].*defaults;
    if (const auto found = here.find(name); found != here.end()) return found->second;
  }
  return "";
}

int DotGraph::add_node(int group, const std::string& name, int line) {
  const auto [place, is_new] = node_of_.try_emplace(name, static_cast<int>(nodes_.size()));
  const int node = place->second;
  if (is_new) nodes_.push_back({name, find_default(group, &Group::node_defaults, "root"), line});
  for (int g = group; g >= 0 && groups_[index(g)].nodes.insert(node).second;)
    g = groups_[index(g)].around;
  return node;
}

int DotGraph::find_edge(int tail, int head, const Key& key) const {
  const auto [first, last] = between_.equal_range({tail, head});
  for (auto at = first; at != last; ++at)
    if (!key || edges_[index(at->second)].key == key) return at->second;
  return -1;
}

// Returns the number of the edge, or -1 if Graphviz would make no edge here.
int DotGraph::find_or_add_edge(int group, int tail, int head, const Key& key, int line) {
  if (is_strict_ || key) {
    int found = find_edge(tail, head, key);
    if (found < 0 && !is_directed_) found = find_edge(head, tail, key);
    if (found >= 0) return found;
    if (is_strict_ && find_edge(tail, head, std::nullopt) >= 0) return -1;
  }
  const auto edge = static_cast<int>(edges_.size());
  edges_.push_back({tail, head, line, key, {}});
  for (const auto* name : EDGE_ATTRIBUTES)
    if (const auto value = find_default(group, &Group::edge_defaults, name); !value.empty())
      edges_.back().attributes[name] = value;
  between_.emplace(std::pair(tail, head), edge);
  return edge;
}

void DotGraph::add_edge(int group, DotEnd tail, DotEnd head, const DotAttributes& attributes,
                        int line) {
  const auto key = attributes.find("key");
  const int number = find_or_add_edge(group, tail.node, head.node,
                                      key == attributes.end() ? Key() : Key(key->second), line);
  if (number < 0) return;
  auto& edge = edges_[index(number)];
  if (edge.tail != edge.head && edge.head == tail.node) std::swap(tail, head);
  if (tail.port) edge.attributes["tailport"] = *tail.port;
  if (head.port) edge.attributes["headport"] = *head.port;
  copy_known(attributes, EDGE_ATTRIBUTES, edge.attributes);
}

void DotGraph::set_attributes(int node, const DotAttributes& attributes) {
  const auto root = attributes.find("root");
  if (root != attributes.end()) nodes_[index(node)].root = root->second;
}

void DotGraph::set_node_defaults(int group, const DotAttributes& attributes) {
  copy_known(attributes, {"root"}, groups_[index(group)].node_defaults);
}

void DotGraph::set_edge_defaults(int group, const DotAttributes& attributes) {
  copy_known(attributes, EDGE_ATTRIBUTES, groups_[index(group)].edge_defaults);
}

void DotGraph::set_graph_attributes(int group, const DotAttributes& attributes) {
  const auto root = attributes.find("root");
  if (group == 0 && root != attributes.end()) root_ = root->second;
}

RawGraph DotGraph::make_raw() const {
  RawGraph raw{nodes_, {}, root_, is_directed_};
  for (const auto& edge : edges_) {
    const auto text = [&](const char* name) { return find_text(edge.attributes, name); };
    raw.edges.push_back({edge.tail, edge.head, text("port_a"), text("port_b"), text("tailport"),
                         text("headport"), edge.line});
  }
  return raw;
}

}  // namespace topologies

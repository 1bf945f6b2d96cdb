#pragma once
// The graph described by a DOT file, built statement by statement as Graphviz's library does.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "topologies/files/raw_graph.hpp"

namespace topologies {

using DotAttributes = std::map<std::string, std::string>;

/// A node at one end of an edge.
struct DotEnd {
  int node = 0;
  std::optional<std::string> port;  ///< the port in node:port
};

/// The graph and its subgraphs are groups; group 0 is the graph itself. A node belongs to its group
/// and to all enclosing groups. Each group can set default attributes; otherwise, those of the
/// enclosing group apply.
class DotGraph {
 public:
  DotGraph(bool is_strict, bool is_directed) : is_strict_(is_strict), is_directed_(is_directed) {}

  /// Returns the number of the subgraph with this name inside group `around`. Makes a new subgraph
  /// if the name is unknown or absent.
  int open_group(int around, const std::optional<std::string>& name);
  /// Numbers of the nodes in a group, in the order in which the file first mentions them.
  const std::set<int>& nodes_of(int group) const { return groups_[index(group)].nodes; }

  /// Returns the number of the node with this name, counted from 0. If the name is new, makes a
  /// node with the default attributes of the group.
  int add_node(int group, const std::string& name, int line);
  /// Adds an edge with the default attributes of the group. If an edge between the two nodes has
  /// the same attribute `key`, or the graph is strict and this edge has no `key`, changes the
  /// existing edge instead. A strict graph never gets a second edge between two nodes.
  void add_edge(int group, DotEnd tail, DotEnd head, const DotAttributes& attributes, int line);

  void set_attributes(int node, const DotAttributes& attributes);
  void set_node_defaults(int group, const DotAttributes& attributes);
  void set_edge_defaults(int group, const DotAttributes& attributes);
  void set_graph_attributes(int group, const DotAttributes& attributes);

  /// The graph as read so far.
  RawGraph make_raw() const;

 private:
  struct Group {
    int around;
    std::set<int> nodes = {};
    DotAttributes node_defaults = {}, edge_defaults = {};
    std::map<std::string, int> groups = {};  // numbers of the subgraphs, by name
  };
  struct Edge {
    int tail, head, line;
    std::optional<std::string> key;
    DotAttributes attributes;
  };
  using Key = std::optional<std::string>;

  static std::size_t index(int number) { return static_cast<std::size_t>(number); }
  std::string find_default(int group, DotAttributes Group::*defaults,
                           const std::string& name) const;
  int find_edge(int tail, int head, const Key& key) const;
  int find_or_add_edge(int group, int tail, int head, const Key& key, int line);

  bool is_strict_, is_directed_;
  std::vector<Group> groups_{{-1}};
  std::vector<RawVertex> nodes_;
  std::map<std::string, int> node_of_;  // numbers of the nodes, by name
  std::vector<Edge> edges_;
  std::multimap<std::pair<int, int>, int> between_;  // numbers of the edges by tail and head
  std::string root_;
};

}  // namespace topologies

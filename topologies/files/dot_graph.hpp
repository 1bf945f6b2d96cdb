#pragma once
// A graph that the statements of a DOT file make one by one, by the rules of Graphviz's library.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "topologies/files/raw_graph.hpp"

namespace topologies {

using DotAttributes = std::map<std::string, std::string>;

/// A node at the end of an edge.
struct DotEnd {
  int node = 0;
  std::optional<std::string> port;  ///< as in node:port
};

/// Groups are the graph itself, number 0, and its subgraphs. A node belongs to its group and to all
/// groups around that. A group can set defaults of attributes; otherwise it has those of the group
/// around it.
class DotGraph {
 public:
  DotGraph(bool is_strict, bool is_directed) : is_strict_(is_strict), is_directed_(is_directed) {}

  /// The subgraph with this name in group `around`. Makes a new one for an unknown name or without
  /// a name.
  int open_group(int around, const std::optional<std::string>& name);
  /// Nodes of a group in the order of their first mention in the file.
  const std::set<int>& nodes_of(int group) const { return groups_[index(group)].nodes; }

  /// The number of the node with this name, counted from 0. Makes a node with the group's defaults
  /// if the name is new.
  int add_node(int group, const std::string& name, int line);
  /// Adds an edge with the group's defaults. Adds none if an edge between the nodes has the same
  /// `key`, or if the graph is strict and has any edge between them.
  void add_edge(int group, DotEnd tail, DotEnd head, const DotAttributes& attributes, int line);

  void set_attributes(int node, const DotAttributes& attributes);
  void set_node_defaults(int group, const DotAttributes& attributes);
  void set_edge_defaults(int group, const DotAttributes& attributes);
  void set_graph_attributes(int group, const DotAttributes& attributes);

  /// The graph so far.
  RawGraph make_raw() const;

 private:
  struct Group {
    int around;
    std::set<int> nodes = {};
    DotAttributes node_defaults = {}, edge_defaults = {};
    std::map<std::string, int> groups = {};  // by name
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
  std::map<std::string, int> node_of_;  // by name
  std::vector<Edge> edges_;
  std::multimap<std::pair<int, int>, int> between_;  // edges by tail and head
  std::string root_;
};

}  // namespace topologies

// Compares the graphs that tlab reads from files with those that Graphviz and networkx read.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/host_program.hpp"
#include "tests/support/files.hpp"
#include "tests/support/places.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/files/raw_graph.hpp"

namespace topologies {
namespace {

using Fields = std::vector<std::string>;

// Splits a line of the script write_graphs: the word node, edge or root, then its texts.
Fields split_fields(const std::string& line) {
  Fields fields{""};
  for (const char c : line)
    if (c == '\t')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

// Spells the ends of an edge as "name TAB port", in an order that does not depend on the edge's
// direction.
Fields spell_edge(const std::string& a, const std::string& b, const std::string& port_a,
                  const std::string& port_b) {
  Fields edge{a + "\t" + port_a, b + "\t" + port_b};
  std::ranges::sort(edge);
  return edge;
}

// Expects exactly one link for each edge. If an edge names ports, its link must have these ports.
void expect_edges(const Topology& topology, const std::vector<Fields>& edges) {
  const auto names = names_of(topology);
  std::vector<Fields> found, expected, with_ports;
  for (const auto& [a, b] : topology.links) {
    const auto &one = names.at(a.processor), &other = names.at(b.processor);
    found.push_back(spell_edge(one, other, "", ""));
    with_ports.push_back(spell_edge(one, other, std::to_string(a.port), std::to_string(b.port)));
  }
  for (const auto& edge : edges) {
    expected.push_back(spell_edge(edge.at(1), edge.at(2), "", ""));
    const auto ported = spell_edge(edge.at(1), edge.at(2), edge.at(3), edge.at(4));
    EXPECT_TRUE(edge[3].empty() || std::ranges::count(with_ports, ported) == 1)
        << edge[1] << ":" << edge[3] << " to " << edge[2] << ":" << edge[4];
  }
  std::ranges::sort(found), std::ranges::sort(expected);
  EXPECT_EQ(found, expected);
}

void expect_graph(const Topology& topology, Fields nodes, const std::vector<Fields>& edges,
                  const std::string& root) {
  const auto names = names_of(topology);
  if (topology.labels.empty()) {  // the names are 0 to n-1, in any order
    for (const auto& name : names) EXPECT_EQ(std::ranges::count(nodes, name), 1) << name;
    nodes = names;
  }
  EXPECT_EQ(names, nodes);
  const bool is_numbered = topology.labels.empty() && root.empty();
  EXPECT_EQ(names.at(topology.root), is_numbered ? "0" : root.empty() ? nodes[0] : root);
  expect_edges(topology, edges);
}

TEST(TopologyFiles, AreTheGraphsOfGraphvizAndNetworkx) {
  const test::TemporaryFolder folder;
  std::istringstream lines(base::run_program(
      {.name = "env",  // starts the script with Debian's Python
       .arguments = {test::in_sources("tests/topologies/files/write_graphs"), folder.path},
       .purpose = "graphs",
       .remedy = "run .ci/install --tests"}));
  int dot = 0, graphml = 0;
  Fields nodes;
  std::vector<Fields> edges;
  std::string file;
  for (std::string line; std::getline(lines, line);) {
    const auto fields = split_fields(line);
    if (fields[0] == "file") file = fields.at(1), nodes.clear(), edges.clear();
    if (fields[0] == "node") nodes.push_back(fields.at(1));
    if (fields[0] == "edge") edges.push_back(fields);
    if (fields[0] != "root") continue;
    SCOPED_TRACE(file);
    ++(file.ends_with(".graphml") ? graphml : dot);
    ASSERT_NO_THROW(expect_graph(load_topology(file), nodes, edges, fields.at(1)));
  }
  EXPECT_EQ(dot, 200);
  EXPECT_EQ(graphml, 260);
}

}  // namespace
}  // namespace topologies

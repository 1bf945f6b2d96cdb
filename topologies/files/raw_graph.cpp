#include "topologies/files/raw_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numeric>
#include <tuple>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace topologies {
namespace {

// The processor number of each vertex. It is the vertex's name if the names are exactly 0 .. n-1.
// Otherwise it is the vertex's position in the file, and the names become labels.
std::vector<int> number_vertices(const RawGraph& graph, Topology& topology) {
  std::vector<int> in_file(graph.vertices.size()), processor;
  std::iota(in_file.begin(), in_file.end(), 0);
  for (const auto& vertex : graph.vertices) {
    topology.labels.push_back(vertex.name);
    const auto number = base::parse_number<int>(vertex.name);
    processor.push_back(number && std::to_string(*number) == vertex.name ? *number : -1);
  }
  auto sorted = processor;
  std::ranges::sort(sorted);
  if (sorted != in_file) return in_file;
  topology.labels.clear();
  return processor;
}

// True if JSON and every file format can hold the name.
bool is_name(const std::string& text) {
  const auto is_control = [](unsigned char c) { return c < ' ' && c != '\t' && c != '\n'; };
  return !text.empty() && base::trim(text) == text && base::is_utf8(text) &&
         std::ranges::none_of(text, is_control);
}

bool read_flag(const RawVertex& vertex, const std::string& file) {
  const auto is_one_of = [&](std::initializer_list<std::string_view> texts) {
    return std::ranges::find(texts, vertex.root) != texts.end();
  };
  // networkx writes True and False, as Python does
  if (is_one_of({"", "false", "False", "0"})) return false;
  if (is_one_of({"true", "True", "1"})) return true;
  throw base::BadInput(fmt::format("{}: vertex \"{}\": root is \"{}\", expected true or false",
                                   file, vertex.name, vertex.root));
}

int find_root(const RawGraph& graph, const std::string& file) {  // returns -1 without a root
  int root = -1;
  const auto designate = [&](int v) {
    base::require(root < 0 || root == v, file, "both \"{}\" and \"{}\" are designated as root",
                  graph.vertices[std::max(root, 0)].name, graph.vertices[v].name);
    root = v;
  };
  for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v) {
    if (read_flag(graph.vertices[v], file)) designate(v);
    if (!graph.root.empty() && graph.vertices[v].name == graph.root) designate(v);
  }
  base::require(root >= 0 || graph.root.empty(), file,
                "root \"{}\" is not a vertex; the first vertex is \"{}\"", graph.root,
                graph.vertices[0].name);
  return root;
}

int read_port(const RawGraph& graph, const RawEdge& edge, const std::string& text,
              const std::string& file) {  // returns -1 if the attribute is missing
  if (text.empty()) return -1;
  if (text.size() == 1 && text[0] >= '0' && text[0] < '0' + PORTS) return text[0] - '0';
  throw base::BadInput(fmt::format("{}: edge \"{}\" to \"{}\": found port \"{}\", expected 0 to {}",
                                   file, graph.vertices[edge.source].name,
                                   graph.vertices[edge.target].name, text, PORTS - 1));
}

// Gives each end without a port the lowest free one. If no port is free, leaves -1, which `check`
// refuses.
void assign_ports(Topology& topology) {
  std::vector<std::array<bool, PORTS>> used(topology.processors);
  const auto each_end = [&](auto visit) {
    for (auto& [a, b] : topology.links) visit(a), visit(b);
  };
  each_end([&](End& end) {
    if (end.port >= 0) used[end.processor][end.port] = true;
  });
  each_end([&](End& end) {
    if (end.port >= 0) return;
    const auto found = std::ranges::find(used[end.processor], false);
    if (found == used[end.processor].end()) return;
    *found = true;
    end.port = static_cast<int>(found - used[end.processor].begin());
  });
}

}  // namespace

std::vector<std::string> names_of(const Topology& topology) {
  std::vector<std::string> names = topology.labels;
  for (int p = 0; names.size() < static_cast<size_t>(topology.processors); ++p)
    names.push_back(std::to_string(p));
  return names;
}

Topology make_topology(const RawGraph& graph, const std::string& name) {
  base::require(!graph.vertices.empty(), name, "the graph is empty, expected a vertex at least");
  for (const auto& vertex : graph.vertices)
    base::require(is_name(vertex.name), name,
                  "found a vertex called {}, expected UTF-8 without control characters and without "
                  "blanks at its ends",
                  base::quote(vertex.name));
  Topology topology{name, static_cast<int>(graph.vertices.size()), 0, {}, {}, {}};
  topology.has_arrows = graph.has_arrows;
  const auto processor = number_vertices(graph, topology);
  const int root = find_root(graph, name);
  if (root >= 0) topology.root = processor[root];
  for (const auto& edge : graph.edges)
    topology.links.push_back({{processor[edge.source], read_port(graph, edge, edge.port_a, name)},
                              {processor[edge.target], read_port(graph, edge, edge.port_b, name)}});
  assign_ports(topology);
  for (auto& [a, b] : topology.links)
    if (a.processor > b.processor) std::swap(a, b);
  sort_links(topology);
  check(topology);
  return topology;
}

}  // namespace topologies

#include "topologies/files/raw_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace topologies {
namespace {

// Returns the processor number of each vertex. If the vertices' names are exactly 0 to n-1, the
// names are the numbers. Otherwise, vertices are numbered in the file's order, and their names
// become labels.
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

// True if JSON and all file formats can hold the text as a name.
bool is_name(const std::string& text) {
  const auto is_control = [](unsigned char c) { return c < ' ' && c != '\t' && c != '\n'; };
  return !text.empty() && base::trim(text) == text && base::is_utf8(text) &&
         std::ranges::none_of(text, is_control);
}

// The start of a message: the file and its line, or the file alone if the line is 0.
std::string place_in(const std::string& file, int line) {
  return line > 0 ? fmt::format("{}: line {}", file, line) : file;
}

// Reads a true or false value in any letter case, as networkx does: Python writes True and False.
bool read_flag(const RawVertex& vertex, const std::string& file) {
  std::string text = vertex.root;
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (text.empty() || text == "false" || text == "0") return false;
  if (text == "true" || text == "1") return true;
  base::refuse(place_in(file, vertex.line),
               "vertex \"{}\": found root = {}, expected true or false", vertex.name,
               base::quote(vertex.root));
}

// The index of the root vertex; -1 if the file names no root.
int find_root(const RawGraph& graph, const std::string& file) {
  int root = -1;
  const auto designate = [&](int v) {
    base::require(root < 0 || root == v, file, "found two roots, \"{}\" and \"{}\", expected one",
                  graph.vertices[std::max(root, 0)].name, graph.vertices[v].name);
    root = v;
  };
  for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v) {
    if (read_flag(graph.vertices[v], file)) designate(v);
    if (!graph.root.empty() && graph.vertices[v].name == graph.root) designate(v);
  }
  base::require(root >= 0 || graph.root.empty(), file,
                "found root \"{}\", expected a vertex, such as \"{}\"", graph.root,
                graph.vertices[0].name);
  return root;
}

// The number in a port's name such as "2" or, with a compass point, "2:ne"; "" for any other name.
std::string find_number(const std::string& name) {
  const auto number = name.substr(0, name.find(':'));
  const auto digits = number.starts_with('-') ? number.substr(1) : number;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !digits.empty() && std::ranges::all_of(digits, is_digit) ? number : "";
}

bool is_compass_point(const std::string& name) {
  constexpr std::array<std::string_view, 10> POINTS{"n",  "ne", "e",  "se", "s",
                                                    "sw", "w",  "nw", "c",  "_"};
  return std::ranges::find(POINTS, name) != POINTS.end();
}

// The port at one end of an edge: the attribute if it is set, otherwise the number in the port's
// name `name`, otherwise -1. Sets has_port_names if `name` is neither a number nor a compass point.
int read_port(const RawGraph& graph, const RawEdge& edge, const std::string& attribute,
              const std::string& name, const std::string& file, Topology& topology) {
  const auto text = attribute.empty() ? find_number(name) : attribute;
  if (text.empty()) {
    topology.has_port_names |= !name.empty() && !is_compass_point(name);
    return -1;
  }
  if (text.size() == 1 && text[0] >= '0' && text[0] < '0' + PORTS) return text[0] - '0';
  base::refuse(place_in(file, edge.line), "edge \"{}\" to \"{}\": found port {}, expected 0 to {}",
               graph.vertices[edge.source].name, graph.vertices[edge.target].name,
               base::quote(text), PORTS - 1);
}

// Gives each end of a link without a port the lowest free port of its processor. If all four ports
// are used, the port stays -1, which `check` refuses.
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
  base::require(!graph.vertices.empty(), name,
                "found an empty graph, expected at least one vertex");
  for (const auto& vertex : graph.vertices)
    base::require(is_name(vertex.name), place_in(name, vertex.line),
                  "found a vertex called {}, expected a name in UTF-8 without control characters "
                  "and without blanks at its ends",
                  base::quote(vertex.name));
  Topology topology{name, static_cast<int>(graph.vertices.size()), 0, {}, {}, {}};
  topology.has_arrows = graph.has_arrows;
  const auto processor = number_vertices(graph, topology);
  const int root = find_root(graph, name);
  if (root >= 0) topology.root = processor[root];
  for (const auto& edge : graph.edges) {
    const int a = read_port(graph, edge, edge.port_a, edge.name_a, name, topology);
    const int b = read_port(graph, edge, edge.port_b, edge.name_b, name, topology);
    topology.links.push_back({{processor[edge.source], a}, {processor[edge.target], b}});
  }
  assign_ports(topology);
  for (auto& [a, b] : topology.links)
    if (a.processor > b.processor) std::swap(a, b);
  sort_links(topology);
  check(topology);
  return topology;
}

}  // namespace topologies

#include "topologies/files/dot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "topologies/files/dot_graph.hpp"
#include "topologies/files/dot_tokens.hpp"

namespace topologies {
namespace {

constexpr int MAX_NESTING = 100;
constexpr std::size_t MAX_EDGES = 1 << 20;  // eight times the links of the largest topology

using Kind = DotToken::Kind;

// Reads one graph, statement by statement.
class DotReader {
 public:
  DotReader(const std::string& text, const std::string& file) : tokens_(text, file) {}

  RawGraph read();

 private:
  // One side of an edge: either nodes or a subgraph.
  struct Operand {
    int group = -1;                 // number of the subgraph; -1 for nodes
    std::vector<DotEnd> ends = {};  // the nodes, if there is no subgraph
  };

  bool sees_name() const;
  bool sees_operand() const { return sees_name() || tokens_.sees("subgraph") || tokens_.sees("{"); }
  std::string take_name(std::string_view expected);
  DotAttributes take_attributes();
  void read_statements(int group);
  void read_statement(int group);
  void read_defaults(int group);
  void read_edges(int group, Operand first, int line);
  Operand take_operand(int group);
  Operand take_nodes(int group, std::string name, int line);
  int take_subgraph(int around);
  void link(int group, const Operand& tails, const Operand& heads, const DotAttributes& attributes,
            int line);
  std::size_t count_ends(const Operand& operand) const;
  std::vector<DotEnd> list_ends(const Operand& operand) const;

  DotTokens tokens_;
  DotGraph graph_{false, false};
  std::string_view edge_ = "--";
  int depth_ = 0;
  std::size_t edges_ = 0;
};

RawGraph DotReader::read() {
  const bool is_strict = tokens_.accept("strict");
  const bool is_directed = tokens_.accept("digraph");
  if (!is_directed && !tokens_.accept("graph"))
    tokens_.refuse(is_strict ? "graph or digraph" : "graph, digraph or strict");
  if (is_directed) edge_ = "->";
  graph_ = DotGraph(is_strict, is_directed);
  if (sees_name()) take_name("");
  read_statements(0);
  if (tokens_.peek().kind != Kind::end) tokens_.refuse("only one graph");
  return graph_.make_raw();
}

bool DotReader::sees_name() const {
  return tokens_.peek().kind == Kind::word || tokens_.peek().kind == Kind::string;
}

// Takes a name: a word, or strings joined by +.
std::string DotReader::take_name(std::string_view expected) {
  if (!sees_name()) tokens_.refuse(expected);
  auto token = tokens_.take();
  while (token.kind == Kind::string && tokens_.accept("+")) {
    if (tokens_.peek().kind != Kind::string)
      tokens_.refuse("a string in double quotes after \"+\"");
    token.text += tokens_.take().text;
  }
  return token.text;
}

// Takes the attributes in any number of square brackets. If a name occurs twice, the last value
// counts.
DotAttributes DotReader::take_attributes() {
  DotAttributes attributes;
  while (tokens_.accept("["))
    while (!tokens_.accept("]")) {
      const auto name = take_name("an attribute or \"]\"");
      tokens_.require("=");
      attributes[name] = take_name("an attribute's value");
      if (!tokens_.accept(",")) tokens_.accept(";");
    }
  return attributes;
}

void DotReader::read_statements(int group) {
  if (++depth_ > MAX_NESTING) tokens_.refuse(fmt::format("at most {} nested braces", MAX_NESTING));
  tokens_.require("{");
  while (!tokens_.accept("}")) {
    if (tokens_.peek().kind == Kind::end) tokens_.refuse("\"}\"");
    read_statement(group);
    tokens_.accept(";");
  }
  --depth_;
}

void DotReader::read_statement(int group) {
  const int line = tokens_.peek().line;
  if (tokens_.sees("graph") || tokens_.sees("node") || tokens_.sees("edge"))
    return read_defaults(group);
  if (!sees_name()) return read_edges(group, take_operand(group), line);
  const auto name = take_name("");
  if (tokens_.accept("="))
    graph_.set_graph_attributes(group, {{name, take_name("an attribute's value")}});
  else
    read_edges(group, take_nodes(group, name, line), line);
}

void DotReader::read_defaults(int group) {
  const auto kind = tokens_.take().text;
  if (!tokens_.sees("[")) tokens_.refuse(fmt::format("\"[\" after \"{}\"", kind));
  const auto attributes = take_attributes();
  if (kind == "graph") graph_.set_graph_attributes(group, attributes);
  if (kind == "node") graph_.set_node_defaults(group, attributes);
  if (kind == "edge") graph_.set_edge_defaults(group, attributes);
}

// Reads the rest of an edge statement after its first operand. Adds the edges only after all
// operands have been read: a subgraph can occur in several operands, and each of them can add nodes
// to it.
void DotReader::read_edges(int group, Operand first, int line) {
  std::vector<Operand> chain{std::move(first)};
  while (tokens_.accept(edge_)) chain.push_back(take_operand(group));
  if (tokens_.sees("--") || tokens_.sees("->"))
    tokens_.refuse(fmt::format("\"{}\" in a {}", edge_, edge_ == "--" ? "graph" : "digraph"));
  const auto attributes = take_attributes();
  if (chain.size() == 1)
    for (const auto& end : chain[0].ends) graph_.set_attributes(end.node, attributes);
  for (std::size_t i = 1; i < chain.size(); ++i)
    link(group, chain[i - 1], chain[i], attributes, line);
}

DotReader::Operand DotReader::take_operand(int group) {
  const int line = tokens_.peek().line;
  if (sees_name()) return take_nodes(group, take_name(""), line);
  if (!tokens_.sees("subgraph") && !tokens_.sees("{")) tokens_.refuse("a node or a subgraph");
  return {.group = take_subgraph(group)};
}

// Takes a list of nodes separated by commas; each node may have a port and a compass point. The
// name of the first node has already been taken; it is `name`.
DotReader::Operand DotReader::take_nodes(int group, std::string name, int line) {
  Operand operand;
  while (true) {
    DotEnd end{graph_.add_node(group, name, line), std::nullopt};
    if (tokens_.accept(":")) {
      end.port = take_name("a port");
      if (tokens_.accept(":")) *end.port += ":" + take_name("a compass point");
    }
    operand.ends.push_back(end);
    if (!tokens_.accept(",")) return operand;
    line = tokens_.peek().line;
    name = take_name("a node");
  }
}

int DotReader::take_subgraph(int around) {
  std::optional<std::string> name;
  if (tokens_.accept("subgraph") && sees_name()) name = take_name("");
  const int group = graph_.open_group(around, name);
  read_statements(group);
  return group;
}

std::size_t DotReader::count_ends(const Operand& operand) const {
  return operand.group < 0 ? operand.ends.size() : graph_.nodes_of(operand.group).size();
}

std::vector<DotEnd> DotReader::list_ends(const Operand& operand) const {
  if (operand.group < 0) return operand.ends;
  std::vector<DotEnd> ends;
  for (const int node : graph_.nodes_of(operand.group)) ends.push_back({node, std::nullopt});
  return ends;
}

// Adds an edge from each node of `tails` to each node of `heads`.
void DotReader::link(int group, const Operand& tails, const Operand& heads,
                     const DotAttributes& attributes, int line) {
  const auto pairs = count_ends(tails) * count_ends(heads);
  edges_ += pairs;
  base::require(edges_ <= MAX_EDGES, fmt::format("{}: line {}", tokens_.file(), line),
                "found {} edges, expected at most {}", edges_, MAX_EDGES);
  if (pairs == 0) return;
  const auto to = list_ends(heads);
  for (const auto& tail : list_ends(tails))
    for (const auto& head : to) graph_.add_edge(group, tail, head, attributes, line);
}

// True if a quoted string can hold the text. DOT keeps a backslash as it is, except directly before
// a quote or a line end, where a single backslash is an escape.
bool can_quote(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') continue;
    if (i + 1 == text.size() || text[i + 1] == '"' || text[i + 1] == '\n') return false;
    ++i;  // the character after the backslash
  }
  return true;
}

std::string quote(const std::string& text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const bool is_number = !text.empty() && std::ranges::all_of(text, is_digit);
  const bool is_name =
      !text.empty() && is_plain(text[0]) && !is_dot_keyword(text) &&
      std::ranges::all_of(text, [&](char c) { return is_plain(c) || is_digit(c); });
  if (is_number || is_name) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\\\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

Topology read_dot(const std::string& text, const std::string& name) {
  return make_topology(DotReader(text, name).read(), name);
}

std::string to_dot(const Topology& topology) {
  std::vector<std::string> names;
  for (const auto& name : names_of(topology)) {
    base::require(can_quote(name), topology.name,
                  "found a processor \"{}\", expected no backslash before a quote or at the end: "
                  "DOT cannot represent it",
                  name);
    names.push_back(quote(name));
  }
  auto title = topology.name;  // shown only to human readers; read_dot ignores it
  if (!can_quote(title)) std::ranges::replace(title, '\\', '/');
  std::string text =
      fmt::format("graph G {{\nlabel={};\nroot={};\nnode [shape=circle];\nedge [fontsize=8];\n",
                  quote(title), names[topology.root]);
  for (int p = 0; p < topology.processors; ++p)
    text += fmt::format("{}{};\n", names[p], p == topology.root ? " [peripheries=2]" : "");
  for (const auto& [a, b] : topology.links)
    text += fmt::format("{0}--{1}  [port_a={2}, port_b={3}, taillabel={2}, headlabel={3}];\n",
                        names[a.processor], names[b.processor], a.port, b.port);
  return text + "}\n";
}

}  // namespace topologies

#include "topologies/files/dot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graphviz.hpp>
#include <cctype>
#include <map>
#include <numeric>
#include <sstream>

#include "base/errors.hpp"
#include "topologies/files/raw_graph.hpp"

namespace topologies {
namespace {

constexpr int MAX_NESTING = 100;

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' ||
         static_cast<unsigned char>(c) >= 128;
}

size_t skip_past(std::string_view text, size_t from, std::string_view end) {
  const auto found = text.find(end, from);
  return found == text.npos ? text.size() : found + end.size();
}

// Length of the token at `at`: white space, a comment, a quoted string, HTML, a word or a single
// symbol.
size_t measure_token(std::string_view text, size_t at) {
  const auto rest = text.substr(at);
  const auto run = [&](auto belongs) {
    return static_cast<size_t>(std::ranges::find_if_not(rest, belongs) - rest.begin());
  };
  if (is_space(rest[0])) return run(is_space);
  if (is_word(rest[0])) return run(is_word);
  if (rest.starts_with("--") || rest.starts_with("->")) return 2;
  if (rest.starts_with("//")) return skip_past(rest, 2, "\n");
  if (rest.starts_with("/*")) return skip_past(rest, 2, "*/");
  if (rest[0] == '#' && (at == 0 || text[at - 1] == '\n')) return skip_past(rest, 1, "\n");
  if (rest[0] == '"') {
    size_t i = 1;
    while (i < rest.size() && rest[i] != '"') i += rest[i] == '\\' ? 2 : 1;
    return std::min(i + 1, rest.size());
  }
  if (rest[0] == '<') {
    int depth = 0;
    size_t i = 0;
    do depth += rest[i] == '<' ? 1 : rest[i] == '>' ? -1 : 0;
    while (++i < rest.size() && depth > 0);
    return i;
  }
  return 1;
}

bool is_gap(std::string_view token) {
  return is_space(token[0]) || token[0] == '#' || token.starts_with("//") ||
         token.starts_with("/*");
}

bool is_identifier(std::string_view token) {
  return !token.empty() && (is_word(token[0]) || token[0] == '"');
}

// True if an unquoted word is a DOT keyword. Keywords ignore case.
bool is_keyword(std::string_view word) {
  std::string lower;
  for (const unsigned char c : word) lower += static_cast<char>(std::tolower(c));
  return lower == "graph" || lower == "digraph" || lower == "subgraph" || lower == "node" ||
         lower == "edge" || lower == "strict";
}

std::string unquote(std::string_view token) {
  if (token.size() < 2 || token[0] != '"') return std::string(token);
  std::string result;
  for (size_t i = 1; i + 1 < token.size(); ++i)
    if (token.substr(i, 2) != "\\\"") result += token[i];
  return result;
}

// Preprocessed text for Boost's DOT reader, and the order of names, which the reader does not keep.
struct DotText {
  std::string text;                  // has the keyword `subgraph` before every nested brace
  std::map<std::string, int> place;  // index by identifier, in the order of first mention
};

// Scans the tokens of `text` once. Refuses three things that Boost's reader cannot handle. It would
// drop the port in node:port, overflow the stack on deeply nested braces, and link all pairs of
// nodes for an edge between two groups.
DotText make_dot_text(const std::string& text, const std::string& file) {
  DotText result;
  std::string_view before, last;  // the last two tokens
  int line = 1, braces = 0, last_braces = 0, brackets = 0, named = 0;
  const auto refuse = [&](const std::string& what) {
    throw base::BadInput(fmt::format("{}: line {}: {}", file, line, what));
  };
  const size_t start = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  for (size_t at = start, length = 0; at < text.size(); at += length) {
    length = measure_token(text, at);
    const auto token = std::string_view(text).substr(at, length);
    const char c = token[0];
    if (c == '{' && ++braces > MAX_NESTING)
      refuse(fmt::format("more than {} nested braces", MAX_NESTING));
    if (c == ':' && brackets == 0)
      refuse(fmt::format(
          "found a port after a node (\"{}:\"), expected the edge attributes port_a and port_b",
          last));
    const bool joins_groups = (last == "--" || last == "->") && before == "}";
    if (joins_groups && (c == '{' || token == "subgraph"))
      refuse("an edge joins two groups in braces, expected a node at one side");
    if (c == '{' && braces > 1 && last != "subgraph" && before != "subgraph")
      result.text += "subgraph ";
    result.text += token;
    line += static_cast<int>(std::ranges::count(token, '\n'));
    if (is_gap(token)) continue;
    const bool assigned = c == '=' || before == "=";  // is the name or value of an attribute
    const bool is_node = last_braces > 0 && before != "subgraph" && !is_keyword(last);
    if (brackets == 0 && is_identifier(last) && is_node && !assigned)
      named += result.place.try_emplace(unquote(last), named).second;
    braces -= c == '}', brackets += (c == '[') - (c == ']');
    last_braces = braces;
    before = last, last = token;
  }
  return result;
}

struct Edge {
  std::string port_a, port_b, tailport, headport;
};

// Returns our port attribute if present. Otherwise returns Graphviz's, unless it is a compass
// point.
std::string choose_port(const std::string& ours, const std::string& graphviz) {
  const bool is_number =
      !graphviz.empty() && graphviz.find_first_not_of("0123456789") == std::string::npos;
  return ours.empty() && is_number ? graphviz : ours;
}

template <typename Directedness>
RawGraph read_raw(const std::string& text) {
  using Graph =
      boost::adjacency_list<boost::vecS, boost::vecS, Directedness, RawVertex, Edge, std::string>;
  Graph graph;
  boost::dynamic_properties properties(boost::ignore_other_properties);
  boost::ref_property_map<Graph*, std::string> root(get_property(graph));
  properties.property("root", root);
  properties.property("root", get(&RawVertex::root, graph));
  properties.property("node_id", get(&RawVertex::name, graph));
  properties.property("port_a", get(&Edge::port_a, graph));
  properties.property("port_b", get(&Edge::port_b, graph));
  properties.property("tailport", get(&Edge::tailport, graph));
  properties.property("headport", get(&Edge::headport, graph));
  boost::read_graphviz(text, graph, properties);

  RawGraph raw;
  raw.root = get_property(graph);
  for (auto [v, end] = vertices(graph); v != end; ++v) raw.vertices.push_back(graph[*v]);
  for (auto [e, end] = edges(graph); e != end; ++e)
    raw.edges.push_back({static_cast<int>(source(*e, graph)), static_cast<int>(target(*e, graph)),
                         choose_port(graph[*e].port_a, graph[*e].tailport),
                         choose_port(graph[*e].port_b, graph[*e].headport)});
  return raw;
}

// Restores the file's order of vertices, because Boost's reader sorts them by name.
void restore_order(RawGraph& raw, const std::map<std::string, int>& place) {
  std::vector<int> order(raw.vertices.size()), now(raw.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int v) {
    const auto found = place.find(raw.vertices[v].name);
    return found == place.end() ? static_cast<int>(place.size()) : found->second;
  });
  std::vector<RawVertex> sorted;
  for (const int v : order) {
    now[v] = static_cast<int>(sorted.size());
    sorted.push_back(raw.vertices[v]);
  }
  raw.vertices = std::move(sorted);
  for (auto& edge : raw.edges) edge.source = now[edge.source], edge.target = now[edge.target];
}

RawGraph read_raw(const std::string& text, const std::string& name) {
  try {
    try {
      return read_raw<boost::undirectedS>(text);
    } catch (const boost::directed_graph_error&) {
      auto raw = read_raw<boost::directedS>(text);
      raw.has_arrows = true;
      return raw;
    }
  } catch (const std::exception& error) {
    throw base::BadInput(fmt::format("{}: malformed DOT: {}", name, error.what()));
  }
}

// True if the text can be written as a quoted string. Boost's reader keeps backslashes, and a quote
// after a backslash does not end the string.
bool can_quote(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') continue;
    if (i + 1 == text.size() || text[i + 1] == '"' || text[i + 1] == '\n') return false;
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
      !text.empty() && is_plain(text[0]) && !is_keyword(text) &&
      std::ranges::all_of(text, [&](char c) { return is_plain(c) || is_digit(c); });
  if (is_number || is_name) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\\\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

Topology read_dot(const std::string& text, const std::string& name) {
  const auto dot = make_dot_text(text, name);
  auto raw = read_raw(dot.text, name);
  restore_order(raw, dot.place);
  return make_topology(raw, name);
}

std::string to_dot(const Topology& topology) {
  std::vector<std::string> names;
  for (const auto& name : names_of(topology)) {
    base::require(can_quote(name), topology.name,
                  "the processor \"{}\": DOT cannot hold a backslash before a quote or at the end",
                  name);
    names.push_back(quote(name));
  }
  auto title = topology.name;  // Boost's DOT reader ignores it
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

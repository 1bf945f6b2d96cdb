// Topologies as files and texts: DOT and GraphML both ways; CSV, SVG and a table of metrics out.
//
// Reading. Each edge of a DOT or GraphML graph, directed or not, is one link.
// - Processors are numbered in the order the file first names them, unless the names are exactly
//   0 .. n-1: then by name. In GraphML a node's name is its attribute `name`, else its id.
// - Edge attributes `port_a` and `port_b` (or `tailport` and `headport`, where numeric) are the
//   ports, 0 to 3, at the edge's first and second vertex. Ends without one then get, in the file's
//   order of edges, the lowest port left.
// - The root is the vertex with attribute `root` true, or the one that the graph's attribute
//   `root` names; else processor 0.
// The readers are Boost.Graph's: DOT's node:port, which they would drop, is an
// error, and so is an edge from one group in braces to another.
#pragma once

#include <string>

#include "topologies/graph/metrics.hpp"
#include "topologies/graph/topology.hpp"

namespace topologies {

// Reads a .dot, .gv or .graphml file. The result has passed `check`. Throws BadInput, with
// the path, when it cannot be read, is malformed (with the line, where the parser gives one), or is
// no topology.
Topology load_topology(const std::string& path);

// The same of a text; `name` stands for the path in Topology::name and in messages.
Topology read_dot(const std::string& text, const std::string& name);
Topology read_graphml(const std::string& text, const std::string& name);

// Read back, these give the same processors, root, ports and labels.
std::string to_dot(const Topology& topology);
std::string to_graphml(const Topology& topology);

// One row per link: processor_a,port_a,processor_b,port_b.
std::string to_csv(const Topology& topology);

// A drawing by Graphviz: `dot` for wirings without cycles, `neato` for others. Throws
// std::runtime_error when Graphviz is not installed or fails.
std::string to_svg(const Topology& topology);

// An aligned table, one metric per row.
std::string to_metrics(const Topology& topology);

}  // namespace topologies

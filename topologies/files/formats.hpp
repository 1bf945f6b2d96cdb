#pragma once
// Topologies as files and texts: DOT and GraphML both ways; CSV and a table of metrics out.

#include <string>

#include "topologies/files/dot.hpp"
#include "topologies/files/graphml.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// Reads a .dot, .gv or .graphml file. Each of its edges, directed or not, is one link.
/// - Processors are numbered in the order in which the file first names them, unless the names are
///   exactly 0 .. n-1: then by name. In GraphML a node's name is its attribute `name`, else its id.
/// - Edge attributes `port_a` and `port_b` (or `tailport` and `headport`, where numeric) are the
///   ports, 0 to 3, at the edge's first and second vertex. Ends without one then get, in the file's
///   order of edges, the lowest port left.
/// - The root is the vertex with attribute `root` true, or the one that the graph's attribute
///   `root` names; else processor 0.
/// The result has passed `check`. Throws BadInput, with the path, when the file cannot be read, is
/// malformed (with the line, where the parser gives one), or is no topology.
Topology load_topology(const std::string& path);

/// One row per link: processor_a,port_a,processor_b,port_b.
std::string to_csv(const Topology& topology);

/// An aligned table, one metric per row.
std::string to_metrics(const Topology& topology);
/// The same, with the mean distance and the busiest link of these routes, and whether they close a
/// cycle of waiting links.
std::string to_metrics(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

#pragma once
// File formats of topologies: reads and writes DOT and GraphML; writes CSV and a table of metrics.

#include <string>

#include "topologies/files/dot.hpp"
#include "topologies/files/graphml.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// Reads a .dot, .gv or .graphml file. Each of its edges, directed or not, is one link.
/// - Processors are numbered in the order of first mention, or by name if the names are exactly
///   0 .. n-1. A GraphML node's name is its attribute `name`, else its id.
/// - Edge attributes `port_a` and `port_b` (or numeric `tailport` and `headport`) are the ports,
///   0 to 3, at the edge's first and second vertex. Other ends get the lowest free port, in the
///   file's order.
/// - The root is the vertex with attribute `root` true, or the vertex named by the graph's
///   attribute `root`; else processor 0.
/// The result has passed `check`. Throws BadInput with the path if the file cannot be read, is
/// malformed (with the line if the parser gives one), or is no topology.
Topology load_topology(const std::string& path);

/// One row per link: processor_a,port_a,processor_b,port_b.
std::string to_csv(const Topology& topology);

/// An aligned table, one metric per row.
std::string to_metrics(const Topology& topology);
/// The same table with the mean distance and the busiest link of these routes. It also says whether
/// they close a cycle of waiting links.
std::string to_metrics(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

#pragma once
// File formats of topologies. DOT and GraphML are read and written. CSV and tables of metrics are
// only written.

#include <string>

#include "topologies/files/dot.hpp"
#include "topologies/files/graphml.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// Reads a .dot, .gv or .graphml file. Each edge, directed or not, becomes one link.
/// - Processors are numbered in the order of first mention in the file. If the names are exactly 0
///   to n-1, the names are the numbers. The name of a GraphML node is its attribute `name`, or its
///   id if it has no `name`.
/// - Edge attributes `port_a` and `port_b` (or numeric `tailport` and `headport`) are the ports, 0
///   to 3, at the first and second vertex. Ends without a port get the lowest free port, in the
///   file's order.
/// - The root is the vertex whose attribute `root` is true, or the vertex named by the graph's
///   attribute `root`. By default it is processor 0.
/// The returned topology passes `check`. Throws BadInput with the path if the file cannot be read,
/// is malformed or is not a topology. The message includes the line if the parser reports it.
Topology load_topology(const std::string& path);

/// Writes CSV with one row per link: processor_a,port_a,processor_b,port_b.
std::string to_csv(const Topology& topology);

/// Formats the topology's metrics as an aligned table with one metric per row.
std::string to_metrics(const Topology& topology);
/// Like to_metrics(topology), with additional rows for messages on `routes`: the mean distance, the
/// busiest link, and whether these messages can deadlock in a cycle of links.
std::string to_metrics(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

#pragma once
// Routes from a file. They replace the shortest routes between some processors.

#include <string>
#include <string_view>

#include "topologies/route/routes.hpp"

namespace topologies {

/// Loads routes from a CSV file with the columns from, to and path. A path is a list of processors
/// such as 0-1-3. The topology must pass `check`.
///
/// A row holds for both directions unless another row gives the opposite direction. A message that
/// is at any processor on a given path to its destination follows this path. Other messages follow
/// make_routes until they reach a given path to their destination. Routes have no loops, but need
/// not be shortest.
///
/// Throws BadInput with file and line if a path has a step without a link, visits a processor
/// twice, or has ends other than `from` and `to`. Also throws if two paths to one destination leave
/// a processor towards different neighbours.
RoutingTable load_routes(const Topology& topology, const std::string& path);

/// Reads a CSV text as load_routes does; `name` replaces the path in messages.
RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name);

constexpr std::string_view XY_ROUTES = "xy";

/// Makes the routes with this name: make_routes for "", make_xy_routes for "xy". Any other name is
/// the path of a CSV file for load_routes.
RoutingTable find_routes(const Topology& topology, const std::string& name);

}  // namespace topologies

#pragma once
// Routes from a file, which replace shortest routes.

#include <string>
#include <string_view>

#include "topologies/route/routes.hpp"

namespace topologies {

/// Loads routes from a CSV file with columns from,to,path, where a path is spelled 0-1-3. The
/// topology must pass `check`.
///
/// A row holds for both directions unless another row gives the opposite direction. Messages from
/// any processor on a given path to its end follow this path. Other messages follow make_routes
/// until they reach a given path to their destination. Routes have no loops but need not be
/// shortest.
///
/// Throws BadInput with file and line if a path has a step without a link, a repeated processor, or
/// ends that differ from its row. Also throws if two paths to one destination leave a processor
/// through different neighbours.
RoutingTable load_routes(const Topology& topology, const std::string& path);

/// Reads a CSV text as load_routes does; `name` replaces the path in messages.
RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name);

constexpr std::string_view XY_ROUTES = "xy";

/// Finds routes by name: "" means make_routes, "xy" make_xy_routes; any other name is the path of a
/// file.
RoutingTable find_routes(const Topology& topology, const std::string& name);

}  // namespace topologies

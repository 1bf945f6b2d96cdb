#pragma once
// Routes that a file gives in place of the shortest ones.

#include <string>
#include <string_view>

#include "topologies/route/routes.hpp"

namespace topologies {

/// Loads routes of a topology that passes `check` from a CSV file with columns from,to,path, a path
/// as 0-1-3. A row is for both directions, unless another one gives the way back. Processors on the
/// way of a given path send along it to the same end; of all other pairs neighbours send directly
/// and others as in make_routes, until they meet a given path. No route is a loop. Paths need not
/// be shortest. Throws BadInput with file and line for a path that steps where no link is, passes a
/// processor twice or ends elsewhere than its row says, and where two paths leave a processor
/// differently for the same end.
RoutingTable load_routes(const Topology& topology, const std::string& path);

/// Reads a text as load_routes does; `name` stands for the path in messages.
RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name);

constexpr std::string_view XY_ROUTES = "xy";

/// The routes of a name: "" of make_routes, "xy" of make_xy_routes, else those of the file of that
/// path.
RoutingTable find_routes(const Topology& topology, const std::string& name);

}  // namespace topologies

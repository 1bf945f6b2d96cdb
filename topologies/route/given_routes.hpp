#pragma once
// Routes from a file, in place of the shortest ones.

#include <string>
#include <string_view>

#include "topologies/route/routes.hpp"

namespace topologies {

/// Loads routes of a topology that passes `check` from a CSV file with columns from,to,path, a path
/// as 0-1-3. A row holds for both directions unless another row gives the way back. Processors on a
/// given path send along it to the path's end. Other pairs use make_routes until they meet a given
/// path. No route is a loop; paths need not be shortest. Throws BadInput with file and line if a
/// path has a step without a link, a repeated processor, or ends that differ from its row. Two
/// paths to one end must not leave a processor differently.
RoutingTable load_routes(const Topology& topology, const std::string& path);

/// Reads a text as load_routes does; `name` stands for the path in messages.
RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name);

constexpr std::string_view XY_ROUTES = "xy";

/// Routes by name: "" for make_routes, "xy" for make_xy_routes, else the path of a file.
RoutingTable find_routes(const Topology& topology, const std::string& name);

}  // namespace topologies

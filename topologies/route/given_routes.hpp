// Routes that a file gives in place of the shortest ones.
#pragma once

#include <string>

#include "topologies/route/routes.hpp"

namespace topologies {

// The routes of a topology that passes `check`, some of them as a CSV file says: columns
// from,to,path, a path as 0-1-3; lines that start with # are comments. A row is for both
// directions. Who is on the way of a given path goes along it to the same end; of all other pairs
// neighbours go direct and others as in make_routes, until they meet a given path. No route is a
// loop. Paths need not be shortest.
// Throws BadInput with file and line for a path that steps where no link is, passes a
// processor twice or ends elsewhere than its row says, and where two paths leave a processor
// differently for the same end.
RoutingTable load_routes(const Topology& topology, const std::string& path);

// The same of a text; `name` stands for the path in messages.
RoutingTable read_routes(const Topology& topology, const std::string& text,
                         const std::string& name);

}  // namespace topologies

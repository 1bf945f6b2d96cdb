#pragma once
// The routers. Each method is in a source file of its name. A Node must outlive its router's
// processes.
#include "simulator/network/node.hpp"

namespace network {

using occam::each;
using occam::pri_alt;

/// Start the processes of a processor's router, all as servers. They have high priority, except in
/// Chalmers's method.
void start_naive(Node& node);
void start_chalmers(Node& node);
void start_green(Node& node);
void start_acyclic(Node& node);

/// Starts a process of a router, named "PROCESSOR.NAME".
template <class Body>
void start_server(Node& node, const std::string& name, Body body,
                  machine::Priority priority = machine::Priority::high) {
  node.processor
      ->start(fmt::format("{}.{}", node.processor->name(), name), priority, std::move(body))
      .set_server();
}

}  // namespace network

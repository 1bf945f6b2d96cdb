#pragma once
// The routers; each method is in a file of its name. The node must outlive the processes.
#include "simulator/network/node.hpp"

namespace network {

using occam::each;
using occam::pri_alt;

/// Start the processes of one processor's router. All are servers; all have high priority, except
/// Chalmers's.
void start_naive(Node& node);
void start_chalmers(Node& node);
void start_green(Node& node);
void start_acyclic(Node& node);

/// Starts a router's process "processor.NAME".
template <class Body>
void start_server(Node& node, const std::string& name, Body body,
                  machine::Priority priority = machine::Priority::high) {
  node.processor
      ->start(fmt::format("{}.{}", node.processor->name(), name), priority, std::move(body))
      .set_server();
}

}  // namespace network

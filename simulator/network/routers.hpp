#pragma once
// The router of each method, in the source file with the method's name. A Node must outlive the
// processes of its router.
#include "simulator/network/node.hpp"

namespace network {

using occam::each;
using occam::pri_alt;

/// These functions start the processes of a processor's router, all of them servers (processes that
/// need not end). They have high priority, except in Chalmers's method.
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

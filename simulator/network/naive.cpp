// The router without a method: takes a message, passes it on, takes the next. Processors that wait
// for each other in a cycle never end.
#include "simulator/network/routers.hpp"

namespace network {

namespace {

void route(Node& node) {
  FairInputs inputs(node);
  for (;;) {
    const int came_by = inputs.wait();
    auto taken = node.take(came_by);
    if (!taken) continue;
    std::vector<Message> to_send{std::move(*taken)};
    for (int by = came_by; !to_send.empty(); by = NO_WAY) {
      Message message = std::move(to_send.back());
      to_send.pop_back();
      const WaysOut ways = node.find_ways_out(message, by);
      for (auto& left_out : node.take_unreached()) to_send.push_back(std::move(left_out));
      for (const int way : ways)
        if (!node.pass(way, message))
          for (auto& again : node.send_around(message, way)) to_send.push_back(std::move(again));
    }
  }
}

}  // namespace

void start_naive(Node& node) {
  start_server(node, "router", [&node] { route(node); });
}

}  // namespace network

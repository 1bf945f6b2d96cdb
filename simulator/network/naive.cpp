// Router without any measure against deadlock: takes a message, passes it on, then takes the next
// one. Routers can wait for each other in a cycle for ever.
#include "simulator/network/routers.hpp"
#include "simulator/occam/process.hpp"

namespace network {

namespace {

void route(Node& node, Message message, int came_by) {
  std::vector<Message> to_send{std::move(message)};
  for (; !to_send.empty(); came_by = NO_WAY) {
    Message next = std::move(to_send.back());
    to_send.pop_back();
    const WaysOut ways = node.find_ways_out(next, came_by);
    for (auto& left_out : node.take_unreached()) to_send.push_back(std::move(left_out));
    for (const int way : ways) {
      occam::this_process().charge(node.costs.way_served);
      if (!node.pass(way, next))
        for (auto& again : node.send_around(next, way)) to_send.push_back(std::move(again));
    }
  }
}

void run(Node& node) {
  const auto inputs = node.inputs();
  for (std::size_t favourite = 0; occam::turn(true); favourite = (favourite + 1) % inputs.size())
    pri_alt(each(inputs, favourite, [&](std::size_t k, std::optional<Message> message) {
      if (message) route(node, std::move(*message), inputs[k].way);
    }));
}

}  // namespace

void start_naive(Node& node) {
  start_server(node, "router", [&node] { run(node); });
}

}  // namespace network

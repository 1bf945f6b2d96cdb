// Functions shared by the tests of routers.
#pragma once

#include "simulator/network/network.hpp"
#include "tests/support/lab.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/make/generators.hpp"

namespace network {

using occam::isolated;
using topologies::random_topology;

constexpr Method METHODS[] = {Method::chalmers, Method::green, Method::acyclic};

// A machine with a network, and with a low-priority application process on chosen processors.
struct Bench {
  explicit Bench(const topologies::Topology& topology, Params params = {},
                 std::optional<TreeLinks> tree = {}, std::uint64_t memory = 4 << 20) {
    for (int id = 0; id < topology.processors; ++id)
      machine.add_processor(fmt::format("p{}", id), memory);
    network.emplace(machine,
                    make_routing(params.method, topology, topologies::make_routes(topology), tree),
                    params);
  }
  void start(int id, const std::function<void(Client&)>& body) {
    machine.processors()[id]->start("application", occam::Priority::low,
                                    [this, id, body] { body(network->client(id)); });
  }
  // Starts a process that receives messages for ever.
  void start_sink(int id, const std::function<void(const Message&)>& taken = {}) {
    start(id, [taken](Client& client) {
      occam::this_process().set_server();
      for (;;) {
        const Message message = client.receive();
        if (taken) taken(message);
      }
    });
  }
  machine::Machine machine{machine::load_model("t805-25")};
  std::optional<Network> network;
};

inline Message make_message(Address to, std::uint64_t number = 0, std::uint64_t length = 4) {
  Message message;
  message.to = to;
  message.number = number;
  message.length = length;
  return message;
}

}  // namespace network

#pragma once
// What the programs over routers share: their parameters, their network, an application's costs.
#include <cmath>

#include "base/errors.hpp"
#include "simulator/declare/support.hpp"
#include "simulator/network/network.hpp"

namespace programs {

inline Parameter method_parameter() {
  return make_choice("method", {"green", "chalmers", "acyclic", "naive"},
                     "how routers avoid deadlock; acyclic takes the network's routes only if they "
                     "close no cycle");
}

inline network::Method method_of(const Setup& setup) {
  static constexpr network::Method METHODS[] = {network::Method::green, network::Method::chalmers,
                                                network::Method::acyclic, network::Method::naive};
  return METHODS[setup.whole("method")];
}

// [program] keys of every program over routers. The first message length is the longest.
inline std::vector<Parameter> router_parameters(std::vector<Parameter> own) {
  std::vector<Parameter> all{
      method_parameter(),
      make_choice("within", {"pointers", "copies"},
                  "how a message is passed within a processor: by pointer, or copied"),
      {"buffers", 64, 1, 1e6, true, "messages that a router has room for"}};
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

inline Parameter message_bytes_parameter() {
  return {"message_bytes", 4, 0, 1e9, true, "contents of a message; the identification is 20 more"};
}

inline network::Params network_params(const Setup& setup, std::uint64_t longest) {
  network::Params params;
  params.method = method_of(setup);
  params.pointers = setup.choice("within") == "pointers";
  params.buffers = static_cast<std::size_t>(setup.whole("buffers"));
  params.longest = longest;
  return params;
}

inline network::Routing routing_of(const Setup& setup) {
  return network::make_routing(network_params(setup, 0).method, setup.topology, setup.routes,
                               setup.tree);
}

// A machine of the topology's processors, with the model's memory, and its faults.
struct RouterMachine {
  RouterMachine(const Setup& setup, const network::Params& params) : machine(setup.model) {
    if (params.method == network::Method::acyclic && setup.tree)
      throw base::BadInput(
          "network.tree: found a tree for all senders, expected none with program.method = "
          "\"acyclic\", which has its own");
    for (int id = 0; id < setup.topology.processors; ++id)
      machine.add_processor(fmt::format("p{}", id), get_bytes(setup.model, "worker_memory"));
    network.emplace(machine, routing_of(setup), params);
    for (const PlannedFault& fault : setup.faults) {
      auto& a = *machine.processors()[fault.a];
      if (fault.b < 0)
        machine.stop_processor(a, {fault.at_s});
      else
        machine.cut_link(a, *machine.processors()[fault.b], {fault.at_s});
    }
  }
  machine::Machine machine;
  std::optional<network::Network> network;
};

// The instructions of a compiled application, by operations of the model.
class ApplicationCost {
 public:
  explicit ApplicationCost(const machine::Model& model) : model_(model) {}
  void operator()(const char* operation) const {
    const auto cycles = static_cast<double>(get_operation(model_, operation).value);
    compute({std::llround(cycles * model_.software.occam_factor)});
  }

 private:
  const machine::Model& model_;
};

}  // namespace programs

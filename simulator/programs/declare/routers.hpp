#pragma once
// Parts shared by programs that use routers: parameters, network, and costs of an application.
#include <optional>

#include "simulator/network/network.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

/// Names of the routers' methods to avoid deadlock. The farm accepts all of them except naive.
inline const base::Names<network::Method> METHODS = {{"green", network::Method::green},
                                                     {"chalmers", network::Method::chalmers},
                                                     {"acyclic", network::Method::acyclic},
                                                     {"naive", network::Method::naive}};

/// Parameters of the routers. A program's parameters contain them as the member `routers`.
struct RouterParams {
  network::Method method = network::Method::green;
  bool pointers = true;  ///< if false, messages within a processor are copied
  std::uint64_t buffers = 64;
};

inline base::Fields<RouterParams> router_fields() {
  using D = base::Declare<RouterParams>;
  static const base::Names<bool> WITHIN = {{"pointers", true}, {"copies", false}};
  return {
      D::choice("method", &RouterParams::method, METHODS,
                "how routers avoid deadlock; acyclic uses the network's routes if they have no "
                "cycle, else its own"),
      D::choice("within", &RouterParams::pointers, WITHIN,
                "how a processor passes messages between its processes: as pointers or as copies"),
      D::whole("buffers", &RouterParams::buffers, 1, 1e6, "",
               "messages that a router has room for")};
}

/// Joins the fields of the routers and the fields `others`.
template <class P>
base::Fields<P> with_routers(const base::Fields<P>& others) {
  return base::join(base::lift_all<P>(router_fields(), &P::routers), {others});
}

/// The field "message_bytes": length of a message's contents in bytes.
template <class P, class Access>
base::Field<P> message_bytes_field(Access access) {
  return base::Declare<P>::whole("message_bytes", access, 0, 1e9, "bytes",
                                 "contents of a message; its identification adds 20 bytes");
}

/// The column "most_held": maximum number of messages in the queues of one router.
template <class R>
base::Column<R> most_held_column(std::size_t R::*most_held) {
  return base::column("most_held", most_held, "largest number of messages held by one router");
}

/// Adds message counts and queue lengths of the routers to a live view. In the machine, the
/// network's processors have the ids `first`, `first` + 1, ...
inline void show(observe::ControlPanel& view, const network::Network& network, int first = 0) {
  const int count = network.routing().processors();
  view.gauges.push_back(
      {"messages in queues", "messages in the queues of all routers", [&network, count] {
         std::size_t held = 0;
         for (int id = 0; id < count; ++id) held += network.held(id);
         return static_cast<double>(held);
       }});
  view.gauges.push_back({"messages delivered", "messages that routers delivered to processes",
                         [&network] { return static_cast<double>(network.use().delivered); }});
  view.inspections.emplace_back([&network, count, first](int processor) {
    const int id = processor - first;
    if (id < 0 || id >= count) return std::vector<observe::ControlPanel::Reading>{};
    const auto& use = network.use(id);
    return std::vector<observe::ControlPanel::Reading>{
        {"messages in the router's queues", static_cast<double>(network.held(id))},
        {"largest number so far", static_cast<double>(use.most_held)},
        {"taken from processes", static_cast<double>(use.taken)},
        {"passed on", static_cast<double>(use.passed)},
        {"delivered", static_cast<double>(use.delivered)}};
  });
}

inline void check_two_processors(const Setup& setup) {
  base::require(setup.topology.processors >= 2, "network.topology",
                "found one processor, expected at least two");
}

/// Makes the parameters of a network. `longest` is the maximum length of a message's contents in
/// bytes.
inline network::Params network_params(const RouterParams& routers, std::uint64_t longest) {
  network::Params params;
  params.method = routers.method;
  params.pointers = routers.pointers;
  params.buffers = static_cast<std::size_t>(routers.buffers);
  params.longest = longest;
  return params;
}

inline network::Routing routing_of(const Setup& setup, network::Method method) {
  return network::make_routing(method, setup.topology, setup.routes, setup.tree);
}

/// A machine for programs in compiled occam. The size of the memories comes from the model.
struct CompiledMachine : Machine {
  CompiledMachine(const Setup& setup, int count) : Machine(setup, count, machine::Code::compiled) {}
};

/// A machine for compiled programs. It has the processors of the topology, a network of routers,
/// and the faults of the setup.
struct RouterMachine : CompiledMachine {
  RouterMachine(const Setup& setup, const network::Params& params)
      : CompiledMachine(setup, setup.topology.processors) {
    base::require(params.method != network::Method::acyclic || !setup.tree, "network.tree",
                  "found a tree for all senders, expected none with program.method = "
                  "\"acyclic\", which has its own");
    network.emplace(*this, routing_of(setup, params.method), params);
    plan_faults(
        *this, setup.faults, [this](int id) -> auto& { return (*this)[id]; });
  }
  /// Starts a process on every processor. The process calls `application` with the processor's
  /// router client.
  template <class Application>
  void start_all(Application application) {
    for (int id = 0; id < static_cast<int>(processors().size()); ++id)
      (*this)[id].start((*this)[id].name() + ".application", Priority::low,
                        [this, id, application] { application(network->client(id)); });
  }

  observe::ControlPanel view() const {
    observe::ControlPanel view;
    show(view, *network);
    return view;
  }

  std::optional<network::Network> network;
};

/// Charges an operation of a compiled application, given by its name in the model.
inline void compute(const char* operation) {
  compute(get_compiled(this_process().processor().model(), operation));
}

}  // namespace programs

// A single packet through an otherwise idle network of routers, to a processor `hops` links away.
#include "simulator/network/store_and_forward.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace unicast {

struct Params {
  std::uint64_t bytes = 100;
  int hops = 1;
};

struct Measured {
  Seconds latency;
  int guards = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  Machine machine(setup, setup.topology.processors);
  network::StoreAndForward network(machine, setup.topology);
  int to = 0;
  while (to < setup.topology.processors && network.routes().distance(0, to) != params.hops) ++to;
  if (to == setup.topology.processors)
    base::refuse("program.hops",
                 "found {}, expected a distance that some processor of {} has from the first",
                 params.hops, setup.topology.name);
  Seconds received;
  machine[0].start("client", Priority::high, [&] {
    wait_for_start();
    out(network.into(0), network::Pointer{{0, to, params.bytes}});
  });
  machine[to].start("client", Priority::high, [&] {
    network.delivered(to).in();
    received = now();
  });
  run_machine(setup, machine);
  return Measured{received - START, network.guards_on_the_way(0, to)};
}

}  // namespace unicast

Program make_unicast() {
  using namespace unicast;
  return make_program<Params, Measured>(
      {.name = "unicast",
       .help = "a packet through an idle network of store-and-forward routers",
       .uses = {.network = true, .others = true, .threads = true},
       .fields = {bytes_field<Params>(&Params::bytes),
                  base::Declare<Params>::whole("hops", &Params::hops, 0, 1000, "",
                                               "links from the first processor to the receiver")},
       .columns = {column("latency_s", &Measured::latency,
                          "from the start of out to the end of in"),
                   column("guards", &Measured::guards,
                          "guards in all ALTs that the packet passes")},
       .run = &run});
}

}  // namespace programs

// One packet through an idle network of routers, to a processor `hops` links away.
#include "base/errors.hpp"
#include "simulator/declare/support.hpp"
#include "simulator/network/store_and_forward.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  machine::Machine machine(setup.model);
  add_processors(machine, setup.topology.processors);
  network::StoreAndForward network(machine, setup.topology);
  const auto hops = static_cast<int>(setup.whole("hops"));
  int to = 0;
  while (to < setup.topology.processors && network.routes().distance(0, to) != hops) ++to;
  if (to == setup.topology.processors)
    throw base::BadInput(
        fmt::format("program.hops: found {}, but no processor of {} is so "
                    "far from the first",
                    hops, setup.topology.name));
  network::Pointer packet, arrived;
  packet.to = {0, to, static_cast<std::uint64_t>(setup.whole("bytes")), 0, START};
  Seconds received;
  machine.processors()[0]->start("client", Priority::high, [&] {
    wait_for_start();
    out(network.into(0), packet);
  });
  machine.processors()[to]->start("client", Priority::high, [&] {
    in(network.delivered(to), arrived);
    received = now();
  });
  run_machine(setup, machine);
  return {{"latency_s", (received - START).value}, {"guards", network.guards_on_the_way(0, to)}};
}

}  // namespace

Pattern make_unicast() {
  return {"unicast",
          "a packet through an idle network of store-and-forward routers, from the first processor "
          "to one `hops` away: latency_s, and the ALT guards it passes",
          true,
          {bytes_parameter(1), {"hops", 1, 0, 1000, true, "links on the way"}},
          &run};
}

}  // namespace programs

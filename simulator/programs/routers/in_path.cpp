// InPathTo requests along a line, which those on the way answer now and then (5.1.1.3).
#include <algorithm>

#include "simulator/declare/random.hpp"
#include "simulator/declare/routers.hpp"
#include "topologies/make/generators.hpp"

namespace programs {

namespace {

using network::Client;
using network::Message;
using network::Mode;

constexpr int ASKED = 0, ASKING = 1;  // kinds of process

// On the way: answers with a probability, else gives the request back. At the end: always answers.
void answer(Client& client, double probability, std::uint64_t seed) {
  this_process().set_server();
  Random random(seed, client.processor());
  for (;;) {
    Message message = client.receive();
    const double uniform = random.uniform();
    const bool passes_by = message.to.processor != client.processor();
    if (passes_by && uniform >= probability) {
      client.give_back(std::move(message));
      continue;
    }
    Message reply;
    reply.to = message.from;
    reply.number = static_cast<std::uint64_t>(message.links);
    client.send(std::move(reply));
  }
}

Rows run(const Setup& setup) {
  const auto n = static_cast<int>(setup.whole("n"));
  const auto requests = setup.whole("requests");
  const auto line = topologies::make_line(n + 1);
  auto params = network_params(setup, 0);
  params.processes.assign(static_cast<std::size_t>(n) + 1, {1U << ASKED});
  params.processes.front() = {1U << ASKING};
  machine::Machine machine(setup.model);
  for (int id = 0; id <= n; ++id)
    machine.add_processor(fmt::format("p{}", id), get_bytes(setup.model, "worker_memory"));
  network::Network network(
      machine, network::make_routing(params.method, line, topologies::make_routes(line)), params);
  double sum = 0, squares = 0;
  for (int id = 1; id <= n; ++id)
    machine.processors()[id]->start("asked", Priority::low, [&, id] {
      answer(network.client(id), setup["s_p"], static_cast<std::uint64_t>(setup.whole("seed")));
    });
  Seconds end;
  machine.processors()[0]->start("asking", Priority::low, [&] {
    Client& client = network.client(0);
    for (std::int64_t i = 0; i < requests; ++i) {
      Message request;
      request.to = {n, ASKED, Mode::in_path_to};
      request.from.process = ASKING;
      client.send(std::move(request));
      const auto links = static_cast<double>(client.receive().number);
      sum += links;
      squares += links * links;
    }
    end = now();
  });
  run_machine(setup, machine);
  const auto count = static_cast<double>(requests);
  const double mean = sum / count, variance = std::max(0.0, squares / count - mean * mean);
  return Row{{"distance_mean", mean},
             {"distance_error", std::sqrt(variance / count)},
             {"saved", 1 - mean / n},
             {"round_trip_s", end.value / count}};
}

}  // namespace

Pattern make_in_path() {
  return {.name = "in_path",
          .help =
              "InPathTo requests from one end of a line to the other, which each processor on "
              "the way answers with probability s_p: distance_mean, the links they pass; "
              "distance_error, its standard error; saved, the share of links spared",
          .uses_topology = false,
          .parameters =
              router_parameters({{"n", 10, 1, 1000, true, "links from end to end"},
                                 {"s_p", 0.1, 0, 1, false, "probability of an answer on the way"},
                                 {"requests", 10000, 1, 1e8, true, "one after the other"},
                                 {"seed", 1, 0, 1e15, true, "of who answers"}}),
          .run = &run};
}

}  // namespace programs

// Requests that travel along a line of processors. Processors on the route sometimes answer them
// (addressing mode InPathTo; thesis, 5.1.1.3).

#include "base/random.hpp"
#include "simulator/programs/declare/routers.hpp"
#include "topologies/make/generators.hpp"

namespace programs {

namespace in_path {

using network::Client;

constexpr int ASKED = 0, ASKING = 1;  // numbers of the processes that answer and that ask

// Process that answers requests. At a request's destination, answers always. On the route, answers
// with `probability`, and otherwise returns the request to the router.
void answer(Client& client, double probability, std::uint64_t seed) {
  this_process().set_server();
  base::Random random(seed, client.processor());
  for (;;) {
    network::Message message = client.receive();
    const double uniform = random.uniform();
    const bool passes_by = message.to.processor != client.processor();
    if (passes_by && uniform >= probability) {
      client.give_back(std::move(message));
      continue;
    }
    client.send({.to = message.from, .number = static_cast<std::uint64_t>(message.links)});
  }
}

struct Params {
  RouterParams routers;
  int links = 10;
  double probability = 0.1;
  std::int64_t requests = 10000;
  std::uint64_t seed = 1;
};

struct Measured {
  double distance_mean = 0, distance_error = 0, saved = 0, round_trip_s = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int n = params.links;
  const auto line = topologies::make_line(n + 1);
  auto on_network = network_params(params.routers, 0);
  on_network.processes.assign(static_cast<std::size_t>(n) + 1, {1U << ASKED});
  on_network.processes.front() = {1U << ASKING};
  CompiledMachine machine(setup, n + 1);
  network::Network network(
      machine, network::make_routing(on_network.method, line, topologies::make_routes(line)),
      on_network);
  double sum = 0, squares = 0;
  for (int id = 1; id <= n; ++id)
    machine[id].start("asked", Priority::low,
                      [&, id] { answer(network.client(id), params.probability, params.seed); });
  Seconds end;
  machine[0].start("asking", Priority::low, [&] {
    Client& client = network.client(0);
    for (std::int64_t i = 0; i < params.requests; ++i) {
      client.send({.to = {n, ASKED, network::Mode::in_path_to}, .from = {0, ASKING}});
      const auto links = static_cast<double>(client.receive().number);
      sum += links;
      squares += links * links;
    }
    end = now();
  });
  observe::ControlPanel view;
  show(view, network);
  run_machine(setup, machine, view);
  const auto count = static_cast<double>(params.requests);
  const double mean = sum / count, variance = std::max(0.0, squares / count - mean * mean);
  return Measured{mean, std::sqrt(variance / count), 1 - mean / n, end.value / count};
}

}  // namespace in_path

Program make_in_path() {
  using namespace in_path;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "in_path",
       .help = "InPathTo requests from one end of a line to the other; each processor on the path "
               "may answer",
       .fields = with_routers<Params>(
           {D::whole("n", &Params::links, 1, 1000, "", "links from end to end"),
            D::number("s_p", &Params::probability, 0, 1, "",
                      "probability that a processor on the path answers"),
            D::whole("requests", &Params::requests, 1, 1e8, "",
                     "number of requests, one after the other"),
            seed_field<Params>(&Params::seed, "seed for the decisions to answer")}),
       .columns = {column("distance_mean", &Measured::distance_mean,
                          "mean number of links that a request passes"),
                   column("distance_error", &Measured::distance_error,
                          "standard error of distance_mean"),
                   column("saved", &Measured::saved,
                          "share of the path's links that requests save"),
                   column("round_trip_s", &Measured::round_trip_s,
                          "mean time from a request to the end of its reply")},
       .run = &run});
}

}  // namespace programs

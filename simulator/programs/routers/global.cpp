// GLOBAL messages from the root, each answered by every other processor (table 5.3).
#include "base/errors.hpp"
#include "simulator/declare/routers.hpp"

namespace programs {

namespace {

using network::Client;
using network::Message;

struct Global {
  const ApplicationCost& cost;
  std::int64_t messages, window;
  std::uint64_t bytes;
  int others;

  // Sends while not too many are unanswered, and takes answers.
  void ask(Client& client) const {
    std::int64_t sent = 0;
    for (std::int64_t answers = 0; answers < messages * others;) {
      if (sent < messages && sent - answers / others < window) {
        Message message;
        message.to = network::make_global(0);
        message.length = bytes;
        cost("message_made");
        client.send(message);
        ++sent;
      } else {
        client.receive();
        cost("message_read");
        ++answers;
      }
    }
  }

  void answer(Client& client) const {
    for (std::int64_t i = 0; i < messages; ++i) {
      Message message;
      message.to = client.receive().from;
      message.length = 4;
      cost("message_read");
      cost("message_made");
      client.send(message);
    }
  }
};

Rows run(const Setup& setup) {
  const auto bytes = static_cast<std::uint64_t>(setup.whole("message_bytes"));
  const int others = setup.topology.processors - 1;
  if (others == 0)
    throw base::BadInput("network.topology: found one processor, expected at least two");
  RouterMachine on(setup, network_params(setup, std::max<std::uint64_t>(bytes, 4)));
  const ApplicationCost cost(setup.model);
  const Global global{cost, setup.whole("messages"), setup.whole("window"), bytes, others};
  for (int id = 0; id <= others; ++id)
    on.machine.processors()[id]->start(fmt::format("p{}.application", id), Priority::low, [&, id] {
      if (id == setup.topology.root)
        global.ask(on.network->client(id));
      else
        global.answer(on.network->client(id));
    });
  run_machine(setup, on.machine);
  const double time_s = on.machine.now().value;
  return Row{{"time_s_per_10000", time_s / static_cast<double>(global.messages) * 1e4},
             {"time_s", time_s},
             {"most_held", static_cast<double>(on.network->use().most_held)},
             {"cpu_busy_root",
              on.machine.processors()[setup.topology.root]->use().busy() / on.machine.now()}};
}

}  // namespace

Pattern make_global_messages() {
  return {.name = "global",
          .help =
              "GLOBAL messages from the root, until every other processor has answered each: "
              "time_s_per_10000",
          .uses_topology = true,
          .parameters = router_parameters(
              {message_bytes_parameter(),
               {"messages", 10000, 1, 1e7, true, "sent by the root"},
               {"window", 8, 1, 1e6, true, "messages that may be unanswered before the next"}}),
          .run = &run,
          .uses_routes = true};
}

}  // namespace programs

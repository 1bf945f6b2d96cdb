// A sequence of broadcast (GLOBAL) messages from the root (thesis, table 5.3). Every other
// processor answers each message, or only the last one.
#include "simulator/programs/declare/routers.hpp"

namespace programs {

namespace global {

using network::Client;

enum class Answers { last, each };
const base::Names<Answers> ANSWERS = {{"each", Answers::each}, {"last", Answers::last}};

struct Params {
  RouterParams routers;
  std::uint64_t bytes = 4;
  std::int64_t messages = 10000, window = 8;
  Answers answers = Answers::each;
};

struct Global {
  const Params& params;
  int others;

  // Process of the root: sends the next message while fewer than `window` messages are unanswered;
  // otherwise receives an answer. If only the last message is answered, sends all without waiting.
  void ask(Client& client) const {
    std::int64_t sent = 0;
    const std::int64_t rounds = params.answers == Answers::each ? params.messages : 1;
    const auto may_send = [&](std::int64_t answers) {
      return sent < params.messages &&
             (params.answers == Answers::last || sent - answers / others < params.window);
    };
    for (std::int64_t answers = 0; answers < rounds * others;) {
      if (may_send(answers)) {
        compute("message_made");
        client.send({.to = network::make_global(0), .length = params.bytes});
        ++sent;
      } else {
        client.receive();
        compute("message_read");
        ++answers;
      }
    }
  }

  void answer(Client& client) const {
    for (std::int64_t i = 1; i <= params.messages; ++i) {
      const auto asking = client.receive().from;
      compute("message_read");
      if (params.answers == Answers::last && i < params.messages) continue;
      compute("message_made");
      client.send({.to = asking, .length = 4});
    }
  }
};

struct Measured {
  double time_s_per_10000 = 0;
  Seconds time;
  std::size_t most_held = 0;
  double cpu_busy_root = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int others = setup.topology.processors - 1, root = setup.topology.root;
  check_two_processors(setup);
  RouterMachine on(setup, network_params(params.routers, std::max<std::uint64_t>(params.bytes, 4)));
  const Global global{params, others};
  on.start_all([&](Client& client) {
    if (client.processor() == root)
      global.ask(client);
    else
      global.answer(client);
  });
  run_machine(setup, on, on.view());
  const Seconds time = on.now();
  return Measured{time.value / static_cast<double>(params.messages) * 1e4, time,
                  on.network->use().most_held, on[root].use().busy() / time};
}

}  // namespace global

Program make_global() {
  using namespace global;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "global",
       .help = "GLOBAL messages from the root to all other processors, which answer",
       .uses = {.network = true, .routes = true, .others = true, .threads = true},
       .fields = with_routers<Params>(
           {message_bytes_field<Params>(&Params::bytes),
            D::whole("messages", &Params::messages, 1, 1e7, "", "messages that the root sends"),
            D::choice("answers", &Params::answers, ANSWERS,
                      "each: the other processors answer every message; last: they answer only the "
                      "last, so routers need a buffer for every message"),
            D::whole(
                "window", &Params::window, 1, 1e6, "",
                "with answers = \"each\": largest number of messages without a complete answer")}),
       .columns = {column("time_s_per_10000", &Measured::time_s_per_10000,
                          "time for 10,000 messages at this rate"),
                   column("time_s", &Measured::time,
                          "time until the root has received all answers"),
                   most_held_column(&Measured::most_held),
                   column("cpu_busy_root", &Measured::cpu_busy_root,
                          "share of the time that the root's CPU worked")},
       .run = &run});
}

}  // namespace programs

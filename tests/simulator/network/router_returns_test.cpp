// Messages to a process that does not exist must return, even if many meet on a link.
#include <gtest/gtest.h>

#include "simulator/network/network.hpp"
#include "tests/support/lab.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace network {
namespace {

TEST(Messages, AreReadOnlyAsTheTypeThatWasSent) {
  using Content = std::variant<int, double>;
  const Message message = make_message(3, {1, 2}, 8, Content(4.5));
  EXPECT_EQ(std::get<double>(read<Content>(message)), 4.5);
  EXPECT_EQ(message.from.process, 3);
  EXPECT_EQ(message.bytes(), Message::IDENTIFICATION + 8);
  EXPECT_THROW(read<double>(message), std::bad_cast);
}

// Every processor sends `each` messages to every other processor, for a process that does not exist
// there. It then receives the messages that come back. Returns the number of messages that came
// back with the right reason.
double send_to_nobody(Method method, const std::string& spec, int each) {
  const auto topology = topologies::make_topology(spec);
  machine::Machine machine(machine::load_model("t805-25"));
  for (int id = 0; id < topology.processors; ++id)
    machine.add_processor(fmt::format("p{}", id), 1'000'000);
  Params params{.method = method, .processes = {}};
  params.processes.assign(topology.processors, {1});
  Network network(machine, make_routing(method, topology, topologies::make_routes(topology)),
                  params);
  const int all = each * (topology.processors - 1);
  int returned = 0;
  for (int id = 0; id < topology.processors; ++id)
    machine.processors()[id]->start("application", machine::Priority::low, [&, id] {
      Client& client = network.client(id);
      for (int k = 0; k < all; ++k)
        client.send({.to = {(id + 1 + k % (topology.processors - 1)) % topology.processors, 7},
                     .from = {},
                     .length = 400,
                     .contents = nullptr});
      for (int k = 0; k < all; ++k)
        returned += client.receive().returned == Returned::no_process ? 1 : 0;
    });
  machine.run();
  return returned;
}

}  // namespace

TEST(RouterReturns, ComeBackWithoutDeadlock) {
  for (const Method method : {Method::chalmers, Method::green, Method::acyclic})
    for (const auto& [spec, each] : {std::pair{"line:2", 10}, {"ring:5", 3}, {"mesh:2x3", 2}}) {
      SCOPED_TRACE(fmt::format("method {}, {}", static_cast<int>(method), spec));
      const int n = topologies::make_topology(spec).processors;
      EXPECT_EQ(occam::isolated_numbers([&, spec = spec, each = each] {
                  return occam::Numbers{send_to_nobody(method, spec, each)};
                }),
                occam::Numbers{static_cast<double>(each * n * (n - 1))});
    }
}

}  // namespace network

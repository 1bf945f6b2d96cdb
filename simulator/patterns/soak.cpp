#include "simulator/patterns/soak.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "simulator/patterns/support.hpp"

namespace patterns {

namespace {

using network::Client;
using network::Message;
using network::Mode;

struct Planned {
  int from = 0, to = 0;
  Mode mode{};
  std::uint64_t length = 0;
  double pause_s = 0;         // before it
  bool answers_half = false;  // an InPathTo message: who answers it is drawn on its way
};

// What is sent, the same for the same seed on any machine.
std::vector<Planned> make_plan(int processors, const SoakParams& params) {
  std::mt19937_64 random(params.seed);
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const auto below = [&](int n) { return static_cast<int>(uniform() * n); };
  std::vector<Planned> plan(params.messages);
  for (auto& p : plan) {
    p.from = below(processors);
    p.to = (p.from + 1 + below(processors - 1)) % processors;
    const double kind = uniform();
    p.mode = kind < params.global                    ? Mode::global
             : kind < params.global + params.in_path ? Mode::in_path_to
                                                     : Mode::unicast;
    p.length = static_cast<std::uint64_t>(uniform() * static_cast<double>(params.longest + 1));
    p.pause_s = -params.pause_s * std::log(uniform());
  }
  return plan;
}

// Every fourth is answered where it is offered: by a processor that the message's number chooses.
bool answers(const Message& message, int here) {
  return (message.number * 0x9e3779b97f4a7c15ULL >> 32) % 4 == static_cast<unsigned>(here) % 4;
}

class Account {
 public:
  Account(const network::Routing& routing, const std::vector<Planned>& plan)
      : routing_(routing), plan_(plan), deliveries_(plan.size()) {}

  void receive(int here, const Message& message) {
    const Planned& sent = plan_.at(message.number);
    if (message.returned != network::Returned::no) {
      ++result.returned;
      return;
    }
    const bool right = sent.mode == Mode::global    ? here != sent.from
                       : sent.mode == Mode::unicast ? here == sent.to
                                                    : on_the_way(sent, here);
    if (!right) ++result.misdelivered;
    auto& got = deliveries_.at(message.number);
    const bool twice =
        sent.mode == Mode::global ? std::ranges::find(got, here) != got.end() : !got.empty();
    if (twice) ++result.duplicated;
    if (right && !twice) ++result.delivered;
    got.push_back(here);
    auto& last = last_[{sent.from, here, static_cast<int>(sent.mode)}];
    if (message.number + 1 < last) ++result.reordered;
    last = std::max(last, message.number + 1);
  }

  SoakResult finish() {
    result.sent = plan_.size();
    for (const auto& p : plan_)
      result.expected +=
          p.mode == Mode::global ? static_cast<unsigned>(routing_.processors()) - 1 : 1;
    result.lost = result.expected - std::min(result.expected, result.delivered);
    return result;
  }

  SoakResult result;

 private:
  bool on_the_way(const Planned& sent, int here) const {
    for (int at = sent.from; at != sent.to;) {
      at = routing_.neighbour(at, routing_.port_to(at, sent.to));
      if (at == here) return true;
    }
    return false;
  }

  const network::Routing& routing_;
  const std::vector<Planned>& plan_;
  std::vector<std::vector<int>> deliveries_;                 // of each message, where
  std::map<std::tuple<int, int, int>, std::uint64_t> last_;  // number + 1
};

// Sends what is planned, and takes what comes meanwhile; then only takes.
void live(Client& client, const std::vector<Planned>& plan, Account& account) {
  const int here = client.processor();
  network::Handed handed;
  const auto take = [&] {
    const Message& message = handed.message;
    const bool passes_by = message.to.mode == Mode::in_path_to && message.to.processor != here;
    if (passes_by && !answers(message, here)) return client.give_back(message);
    account.receive(here, message);
  };
  const auto take_until = [&](Seconds date) {
    for (bool waits = true; waits;)
      occam::pri_alt(occam::when(client.from_router(), handed, take),
                     occam::after(occam::ticks(date), [&] { waits = false; }));
  };
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i].from != here) continue;
    take_until(now() + Seconds{plan[i].pause_s});
    Message message;
    message.to = {plan[i].to, 0, plan[i].mode};
    message.length = plan[i].length;
    message.number = i;
    client.send(std::move(message));
  }
  this_process().set_server();
  for (;;) {
    handed = client.from_router().in();
    take();
  }
}

}  // namespace

SoakResult run_soak(const machine::Model& model, const network::Routing& routing,
                    const SoakParams& params, observe::Watch* watch) {
  const int n = routing.processors();
  machine::Machine machine(model);
  for (int id = 0; id < n; ++id)
    machine.add_processor(fmt::format("p{}", id), get_bytes(model, "worker_memory"));
  network::Network network(machine, routing, params.network);
  const auto plan = n > 1 ? make_plan(n, params) : std::vector<Planned>{};
  Account account(network.routing(), plan);
  for (int id = 0; id < n; ++id)
    machine.processors()[id]->start("application", Priority::low,
                                    [&, id] { live(network.client(id), plan, account); });
  observe::Watch none;
  observe::run(machine, watch ? *watch : none);
  SoakResult result = account.finish();
  result.time_s = machine.now().value;
  result.use = network.use();
  return result;
}

}  // namespace patterns

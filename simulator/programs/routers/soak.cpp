#include "simulator/programs/routers/soak.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "simulator/declare/random.hpp"
#include "simulator/declare/routers.hpp"

namespace programs {

namespace {

using network::Client;
using network::Message;
using network::Mode;

struct Planned {
  int from = 0, to = 0;
  Mode mode{};
  std::uint64_t length = 0;
  double pause_s = 0;  // before it
};

// What is sent, the same for the same seed on any machine.
std::vector<Planned> make_plan(int processors, const SoakParams& params) {
  Random random(params.seed);
  std::vector<Planned> plan(params.messages);
  for (auto& p : plan) {
    p.from = random.below(processors);
    p.to = random.other_than(p.from, processors);
    const double kind = random.uniform();
    p.mode = kind < params.global                    ? Mode::global
             : kind < params.global + params.in_path ? Mode::in_path_to
                                                     : Mode::unicast;
    p.length =
        static_cast<std::uint64_t>(random.uniform() * static_cast<double>(params.longest + 1));
    p.pause_s = params.pause_s * random.exponential();
  }
  return plan;
}

// Every fourth is answered where it is offered: by a processor that the message's number chooses.
bool answers(const Message& message, int here) {
  return (message.number * 0x9e3779b97f4a7c15ULL >> 32) % 4 == static_cast<unsigned>(here) % 4;
}

class Account {
 public:
  // `all_on_the_way`: routes change, and an InPathTo message may be answered anywhere.
  Account(const network::Routing& routing, const std::vector<Planned>& plan, bool all_on_the_way)
      : all_on_the_way_(all_on_the_way),
        routing_(routing),
        plan_(plan),
        deliveries_(plan.size()),
        returns_(plan.size()) {}

  void send(std::size_t number) {
    ++result.sent;
    const bool is_global = plan_[number].mode == Mode::global;
    result.expected += is_global ? static_cast<unsigned>(routing_.processors()) - 1 : 1;
    was_sent_.insert(number);
  }

  void receive(int here, const Message& message) {
    const Planned& sent = plan_.at(message.number);
    if (message.returned != network::Returned::no) {
      auto& back = returns_.at(message.number);
      const auto& got = deliveries_.at(message.number);
      const int from = message.from.processor;
      const bool again =
          std::ranges::find(back, from) != back.end() || std::ranges::find(got, from) != got.end();
      ++(again ? result.duplicated : result.returned);
      back.push_back(from);
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
    links_ += static_cast<std::uint64_t>(message.links);
    auto& last = last_[{sent.from, here, static_cast<int>(sent.mode)}];
    if (message.number + 1 < last) ++result.reordered;
    last = std::max(last, message.number + 1);
  }

  SoakResult finish() {
    result.links_mean = static_cast<double>(links_) /
                        static_cast<double>(std::max<std::uint64_t>(1, result.delivered));
    name_lost();
    return result;
  }

  SoakResult result;

 private:
  bool on_the_way(const Planned& sent, int here) const {
    if (all_on_the_way_) return here != sent.from;
    for (int at = sent.from; at != sent.to;) {
      at = routing_.neighbour(at, routing_.port_to(at, sent.to));
      if (at == here) return true;
    }
    return false;
  }

  // Pairs of sender and receiver, and the numbers of their messages.
  void name_lost() {
    std::map<std::pair<int, int>, std::vector<std::size_t>> lost;
    for (const std::size_t number : was_sent_) {
      const Planned& p = plan_[number];
      const auto gone = [&](int to) {
        const auto &got = deliveries_[number], &back = returns_[number];
        return std::ranges::find(got, to) == got.end() && std::ranges::find(back, to) == back.end();
      };
      if (p.mode != Mode::global) {
        if (deliveries_[number].empty() && returns_[number].empty())
          lost[{p.from, p.to}].push_back(number);
        continue;
      }
      for (int to = 0; to < routing_.processors(); ++to)
        if (to != p.from && gone(to)) lost[{p.from, to}].push_back(number);
    }
    for (const auto& [pair, numbers] : lost) {
      result.lost += numbers.size();
      result.notes.push_back(fmt::format("lost from p{} to p{}: {} message(s), number {}",
                                         pair.first, pair.second, numbers.size(),
                                         fmt::join(numbers, ", ")));
    }
  }

  bool all_on_the_way_;
  const network::Routing& routing_;
  const std::vector<Planned>& plan_;
  std::set<std::size_t> was_sent_;
  std::uint64_t links_ = 0;
  std::vector<std::vector<int>> deliveries_;                 // of each message, where
  std::vector<std::vector<int>> returns_;                    // of each, from whom it came back
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
    account.send(i);
    client.send(std::move(message));
  }
  this_process().set_server();
  for (;;) {
    handed = client.from_router().in();
    take();
  }
}

}  // namespace

SoakResult run_soak(const Setup& setup, const SoakParams& params) {
  const int n = setup.topology.processors;
  if (n < 2) throw base::BadInput("network.topology: found one processor, expected at least two");
  RouterMachine on(setup, network_params(setup, params.longest));
  const auto plan = make_plan(n, params);
  const network::Routing before = routing_of(setup);  // links that are cut change the network's
  Account account(before, plan, !setup.faults.empty());
  for (int id = 0; id < n; ++id)
    on.machine.processors()[id]->start(fmt::format("p{}.application", id), Priority::low,
                                       [&, id] { live(on.network->client(id), plan, account); });
  run_machine(setup, on.machine);
  SoakResult result = account.finish();
  result.time_s = on.machine.now().value;
  result.most_held = on.network->use().most_held;
  return result;
}

namespace {

Rows run(const Setup& setup) {
  SoakParams params;
  params.messages = static_cast<std::uint64_t>(setup.whole("messages"));
  params.longest = static_cast<std::uint64_t>(setup.whole("message_bytes"));
  params.pause_s = setup["pause_s"];
  params.global = setup["global_share"];
  params.in_path = setup["in_path_share"];
  params.seed = static_cast<std::uint64_t>(setup.whole("seed"));
  const auto r = run_soak(setup, params);
  const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
  return Rows({Row{{"time_s", r.time_s},
                   {"sent", number(r.sent)},
                   {"expected", number(r.expected)},
                   {"delivered", number(r.delivered)},
                   {"returned", number(r.returned)},
                   {"lost", number(r.lost)},
                   {"duplicated", number(r.duplicated)},
                   {"misdelivered", number(r.misdelivered)},
                   {"reordered", number(r.reordered)},
                   {"links_mean", r.links_mean},
                   {"most_held", number(r.most_held)}}},
              r.notes);
}

}  // namespace

Pattern make_soak() {
  const SoakParams usual;
  return {.name = "soak",
          .help =
              "random messages of every kind between all processors: how many were delivered, "
              "lost, duplicated, reordered",
          .uses_topology = true,
          .parameters = router_parameters(
              {{"message_bytes", 100, 0, 1e9, true, "contents of the longest message"},
               {"messages", 1000, 1, 1e7, true, "sent, by all together"},
               {"pause_s", usual.pause_s, 1e-6, 1e3, false,
                "between two messages of one sender, on average"},
               {"global_share", usual.global, 0, 1, false, "of the messages, to all"},
               {"in_path_share", usual.in_path, 0, 1, false,
                "of the messages, offered to all on their way"},
               {"seed", 1, 0, 1e15, true, "of all that is random"}}),
          .run = &run,
          .uses_routes = true,
          .uses_faults = true};
}

}  // namespace programs

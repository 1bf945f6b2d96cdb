// Long test of routers with random load. All processors exchange random messages of every kind, and
// the program checks what became of each message.
#include <fmt/ranges.h>

#include <set>

#include "base/random.hpp"
#include "simulator/observe/mean.hpp"
#include "simulator/programs/declare/routers.hpp"

namespace programs {

namespace soak {

using network::Client;
using network::Message;
using network::Mode;

struct Params {
  RouterParams routers;
  std::uint64_t longest = 100, messages = 1000;
  double pause_s = 1e-3, global = 0.02, in_path = 0.2;
  std::uint64_t seed = 1;
};

struct Measured {
  Seconds time;
  std::uint64_t sent = 0, expected = 0, delivered = 0, returned = 0, lost = 0;
  std::uint64_t duplicated = 0, misdelivered = 0, reordered = 0;
  std::optional<double> links_mean = {};
  std::size_t most_held = 0;
};

struct Planned {
  int from = 0, to = 0;
  Mode mode{};
  std::uint64_t length = 0;
  double pause_s = 0;  // delay before the message is sent, in seconds
};

// Makes the plan of messages. It depends only on the arguments, not on the machine's speed.
std::vector<Planned> make_plan(int processors, const Params& params) {
  base::Random random(params.seed);
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

// True if the process on processor `here` answers an offered (InPathTo) message. One in four
// processors answers a given message; the message's number determines which ones.
bool answers(const Message& message, int here) {
  return (message.number * 0x9e3779b97f4a7c15ULL >> 32) % 4 == static_cast<unsigned>(here) % 4;
}

bool contains(const std::vector<int>& processors, int processor) {
  return std::ranges::find(processors, processor) != processors.end();
}

class Account {
 public:
  Account(const network::Routing& routing, const RouterMachine& on,
          const std::vector<Planned>& plan)
      : routing_(routing), on_(on), plan_(plan), deliveries_(plan.size()), returns_(plan.size()) {}

  // Called after a fault, which changes routes: any processor may then answer an offered (InPathTo)
  // message.
  void expect_any_route() { all_on_the_way_ = true; }

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
      const bool again = contains(back, from) || contains(got, from);
      ++(again ? result.duplicated : result.returned);
      back.push_back(from);
      return;
    }
    const bool right = sent.mode == Mode::global    ? here != sent.from
                       : sent.mode == Mode::unicast ? here == sent.to
                                                    : on_the_way(sent, here);
    if (!right) ++result.misdelivered;
    auto& got = deliveries_.at(message.number);
    const bool twice = sent.mode == Mode::global ? contains(got, here) : !got.empty();
    if (twice) ++result.duplicated;
    if (right && !twice) ++result.delivered;
    got.push_back(here);
    links_ += static_cast<std::uint64_t>(message.links);
    auto& last = last_[{sent.from, here, static_cast<int>(sent.mode)}];
    if (message.number + 1 < last) ++result.reordered;
    last = std::max(last, message.number + 1);
  }

  void finish() {
    result.links_mean =
        observe::eval_mean(static_cast<double>(links_), static_cast<double>(result.delivered));
    name_lost();
  }

  Measured result;
  std::vector<std::string> notes;  // lost messages, grouped by sender and receiver

 private:
  bool on_the_way(const Planned& sent, int here) const {
    if (all_on_the_way_) return here != sent.from;
    for (int at = sent.from; at != sent.to;) {
      at = routing_.neighbour(at, routing_.port_to(at, sent.to));
      if (at == here) return true;
    }
    return false;
  }

  // Adds notes about lost messages, grouped by sender and receiver.
  void name_lost() {
    std::map<std::pair<int, int>, std::vector<std::size_t>> lost;
    for (const std::size_t number : was_sent_) {
      const Planned& p = plan_[number];
      const auto &got = deliveries_[number], &back = returns_[number];
      if (p.mode != Mode::global) {
        if (got.empty() && back.empty()) lost[{p.from, p.to}].push_back(number);
        continue;
      }
      for (int to = 0; to < routing_.processors(); ++to)
        if (to != p.from && !contains(got, to) && !contains(back, to))
          lost[{p.from, to}].push_back(number);
    }
    for (const auto& [pair, numbers] : lost) {
      result.lost += numbers.size();
      notes.push_back(fmt::format("lost from {} to {}: {} message(s), number {}",
                                  on_[pair.first].name(), on_[pair.second].name(), numbers.size(),
                                  fmt::join(numbers, ", ")));
    }
  }

  bool all_on_the_way_ = false;
  const network::Routing& routing_;
  const RouterMachine& on_;
  const std::vector<Planned>& plan_;
  std::set<std::size_t> was_sent_;
  std::uint64_t links_ = 0;
  std::vector<std::vector<int>> deliveries_;  // by message: the processors that received it
  std::vector<std::vector<int>> returns_;     // by message: the processors that returned it
  // By sender, receiver and mode: 1 + number of the latest message.
  std::map<std::tuple<int, int, int>, std::uint64_t> last_;
};

// Process that sends the planned messages, receives other messages in between, and afterwards only
// receives.
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
    account.send(i);
    client.send({.to = {plan[i].to, 0, plan[i].mode}, .length = plan[i].length, .number = i});
  }
  this_process().set_server();
  for (;;) {
    handed = client.from_router().in();
    take();
  }
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  check_two_processors(setup);
  RouterMachine on(setup, network_params(params.routers, params.longest));
  const auto plan = make_plan(setup.topology.processors, params);
  // A copy of the routing: when a link is cut, the routing of the network itself changes.
  const network::Routing before = routing_of(setup, params.routers.method);
  Account account(before, on, plan);
  on.on_failure([&account](const machine::Failure&) { account.expect_any_route(); });
  on.start_all([&](Client& client) { live(client, plan, account); });
  run_machine(setup, on, on.view());
  account.finish();
  account.result.time = on.now();
  account.result.most_held = on.network->use().most_held;
  return Outcome<Measured>({account.result}, account.notes);
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return with_routers<Params>(
      {D::whole("message_bytes", &Params::longest, 0, 1e9, "bytes",
                "contents of the longest message; lengths are random up to this"),
       D::whole("messages", &Params::messages, 1, 1e7, "",
                "total number of messages of all processors"),
       D::number("pause_s", &Params::pause_s, 1e-6, 1e3, "s",
                 "mean time between two messages of a sender"),
       D::number("global_share", &Params::global, 0, 1, "", "share of messages to all"),
       D::number("in_path_share", &Params::in_path, 0, 1, "",
                 "share of messages that are offered to every processor on their path; the rest "
                 "are unicast"),
       seed_field<Params>(&Params::seed, "seed for all random choices")});
}

base::Columns<Measured> make_columns() {
  return {
      column("time_s", &Measured::time, "time until the network is empty"),
      column("sent", &Measured::sent, "messages sent"),
      column("expected", &Measured::expected, "expected number of deliveries"),
      column("delivered", &Measured::delivered, "correct deliveries, each counted once"),
      column("returned", &Measured::returned, "messages returned to their senders with a reason"),
      column("lost", &Measured::lost, "expected deliveries neither made nor returned"),
      column("duplicated", &Measured::duplicated, "repeated deliveries of a message"),
      column("misdelivered", &Measured::misdelivered, "deliveries to a wrong processor"),
      column("reordered", &Measured::reordered,
             "deliveries after a later message of the same sender, receiver and mode"),
      column("links_mean", &Measured::links_mean, "mean number of links that a message passes"),
      most_held_column(&Measured::most_held)};
}

}  // namespace soak

Program make_soak() {
  using namespace soak;
  return make_program<Params, Measured>(
      {.name = "soak",
       .help = "random messages of every kind between all processors, with counts of deliveries "
               "and losses",
       .uses = {.network = true, .routes = true, .faults = true, .others = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run});
}

}  // namespace programs

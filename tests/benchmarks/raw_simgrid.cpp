#include "tests/benchmarks/raw_simgrid.hpp"

#include <simgrid/s4u.hpp>

#include <map>

namespace benchmarks {

namespace s4u = simgrid::s4u;

namespace {

// Hosts that are connected as in tlab's machine layer: the rate of a link depends on whether one or
// two messages use it at the same time.
class Platform {
 public:
  explicit Platform(const machine::Model& model) : model_(model), engine_(&argc_, argv_) {
    for (const char* setting :
         {"network/model:CM02", "network/bandwidth-factor:1", "network/latency-factor:1",
          "network/crosstraffic:0", "network/TCP-gamma:0", "surf/precision:1e-12"})
      s4u::Engine::set_config(setting);
    zone_ = s4u::create_full_zone("machine");
  }

  s4u::Host* add_host(int id) {
    return hosts_.emplace_back(
        zone_->create_host(fmt::format("host{}", id), model_.cpu.clock.value)->seal());
  }
  void join(int a, int b) {
    const auto name = fmt::format("{}-{}", a, b);
    const auto rate = [&link = model_.link](double, int messages) {
      return messages > 1 ? link.both_ways_rate : link.one_way_rate;
    };
    const auto* link = zone_->create_link(name, model_.link.both_ways_rate)
                           ->set_sharing_policy(s4u::Link::SharingPolicy::NONLINEAR, rate)
                           ->seal();
    zone_->add_route(hosts_[a]->get_netpoint(), hosts_[b]->get_netpoint(), nullptr, nullptr,
                     {s4u::LinkInRoute(link)}, true);
  }
  s4u::Host* host(int id) const { return hosts_[id]; }

  Sample run(std::uint64_t count) {
    zone_->seal();
    const double cpu_s = time_of([&] { engine_.run(); });
    return {count, cpu_s, s4u::Engine::get_clock(), 0};
  }

 private:
  int argc_ = 2;
  char name_[4] = "raw", quiet_[32] = "--log=root.thres:critical";
  char* argv_[3] = {name_, quiet_, nullptr};
  const machine::Model& model_;
  s4u::Engine engine_;
  s4u::NetZone* zone_ = nullptr;
  std::vector<s4u::Host*> hosts_;
};

s4u::Mailbox* link(int from, int to) {
  return s4u::Mailbox::by_name(fmt::format("{}>{}", from, to));
}

}  // namespace

Sample raw_line(const machine::Model& model) {
  Platform platform(model);
  for (int id = 0; id <= LINE_HOPS; ++id) platform.add_host(id);
  static int payload;
  for (int id = 0; id <= LINE_HOPS; ++id) {
    if (id > 0) platform.join(id - 1, id);
    s4u::Actor::create("relay", platform.host(id), [id] {
      auto *before = link(id - 1, id), *after = link(id, id + 1);
      for (int i = 0; i < LINE_MESSAGES; ++i) {
        int* message = id > 0 ? before->get<int>() : &payload;
        if (id < LINE_HOPS) after->put(message, MESSAGE_BYTES);
      }
    });
  }
  return platform.run(std::uint64_t{LINE_MESSAGES} * LINE_HOPS);
}

// Each incoming link has one receiver. Messages for an outgoing link wait in its mailbox.
Sample raw_mesh(const machine::Model& model, const Traffic& traffic) {
  Platform platform(model);
  for (int node = 0; node < NODES; ++node) platform.add_host(node);
  auto send = [](int node, const int* to) {
    link(node, neighbour(node, route(node, *to)))->put(const_cast<int*>(to), MESSAGE_BYTES);
  };
  for (int node = 0; node < NODES; ++node) {
    s4u::Actor::create("source", platform.host(node), [&, node] {
      for (const int& to : traffic.destinations[node]) send(node, &to);
    });
    for (int direction = 0; direction < DIRECTIONS; ++direction) {
      const int from = neighbour(node, direction);
      if (from < 0) continue;
      if (from > node) platform.join(node, from);
      s4u::Actor::create("receiver", platform.host(node), [&, node, from, direction] {
        auto* incoming = link(from, node);
        for (int i = traffic.leaving[from][opposite(direction)]; i > 0; --i)
          if (const int* to = incoming->get<int>(); *to != node) send(node, to);
      });
    }
  }
  return platform.run(traffic.hops);
}

Sample raw_rendezvous(const machine::Model& model, int messages) {
  Platform platform(model);
  platform.add_host(0);
  const auto sent = s4u::Semaphore::create(0), taken = s4u::Semaphore::create(0);
  const double copy_s =
      (model.channel.soft_setup + model.channel.copy_word) / model.cpu.clock / machine::Seconds{1};
  s4u::Actor::create("out", platform.host(0), [=] {
    for (int i = 0; i < messages; ++i) sent->release(), taken->acquire();
  });
  s4u::Actor::create("in", platform.host(0), [=] {
    for (int i = 0; i < messages; ++i) {
      sent->acquire();
      s4u::this_actor::sleep_for(copy_s);
      taken->release();
    }
  });
  return platform.run(static_cast<std::uint64_t>(messages));
}

Sample raw_preemptions(const machine::Model& model, int times, double period_s, double cycles) {
  Platform platform(model);
  platform.add_host(0);
  s4u::Actor::create("both", platform.host(0), [=, clock = model.cpu.clock.value] {
    const auto low = s4u::this_actor::exec_async(times * period_s * clock);
    for (int i = 1; i <= times; ++i) {
      s4u::this_actor::sleep_until(i * period_s);
      low->suspend();
      s4u::this_actor::execute(cycles);
      low->resume();
    }
    low->wait();
  });
  return platform.run(static_cast<std::uint64_t>(times));
}

Sample raw_activities(const machine::Model& model, const std::vector<Activity>& activities) {
  Platform platform(model);
  std::vector<std::vector<Activity>> of_processor;
  std::map<std::pair<int, int>, int> messages;  // number of messages by sender and receiver
  for (const Activity& activity : activities) {
    const auto last = static_cast<std::size_t>(std::max(activity.processor, activity.to));
    of_processor.resize(std::max(of_processor.size(), last + 1));
    of_processor[static_cast<std::size_t>(activity.processor)].push_back(activity);
    if (activity.to != activity.processor) ++messages[{activity.processor, activity.to}];
  }
  for (std::size_t id = 0; id < of_processor.size(); ++id) {
    platform.add_host(static_cast<int>(id));
    s4u::Actor::create("processor", platform.host(static_cast<int>(id)), [&, id] {
      static int payload;
      std::map<int, s4u::Mailbox*> links;
      for (const Activity& activity : of_processor[id]) {
        if (activity.to == activity.processor) {
          s4u::this_actor::sleep_for(activity.work_s);
          continue;
        }
        auto*& mailbox = links[activity.to];
        if (!mailbox) mailbox = link(activity.processor, activity.to);
        mailbox->put(&payload, activity.bytes);
      }
    });
  }
  for (const auto& [direction, count] : messages) {
    const auto [from, to] = direction;
    if (from < to || !messages.contains({to, from}))
      platform.join(std::min(from, to), std::max(from, to));
    s4u::Actor::create("receiver", platform.host(to), [from = from, to = to, count = count] {
      auto* incoming = link(from, to);
      for (int i = 0; i < count; ++i) incoming->get<int>();
    });
  }
  return platform.run(activities.size());
}

}  // namespace benchmarks

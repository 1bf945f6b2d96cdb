// Random machines: a random topology, and streams of messages relayed by random chains of
// processes.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <random>

#include "tests/support/lab.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace occam {

// The processes of a stream on one processor: one process, or two that are joined by a soft
// channel.
struct Stage {
  int processor;
  bool two;
  Priority priority[2];
  std::int64_t computes;      // cycles of computation for each message
  int polls = 0;              // ticks of waiting for a message before other work; 0: for ever
  bool in_par = false;        // the two processes are branches of a PAR in a third one
  bool by_companion = false;  // a process on the companion relays messages between the two
};

struct Stream {
  std::vector<Stage> stages;
  std::vector<std::uint64_t> lengths;  // lengths of the stream's messages, in bytes
  machine::Seconds begins = {};
};

struct Plan {
  topologies::Topology topology;
  std::vector<Stream> streams;     // at most one stream on each link direction
  std::vector<bool> is_slow = {};  // processors with half the clock rate; empty: none
  std::vector<int> switches = {};  // number of link switches, by link; empty: none
};

inline Plan make_plan(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const char* const specs[] = {"line:5",    "ring:6",      "tree:10", "mesh:3x4",
                               "torus:3x3", "hypercube:4", "star:5"};
  Plan plan{topologies::make_topology(specs[seed % std::size(specs)]), {}};
  const auto routes = topologies::make_routes(plan.topology);
  const auto neighbours = topologies::neighbours(plan.topology);
  std::map<std::pair<int, int>, bool> taken;
  const auto pick = [&] { return static_cast<int>(random() % plan.topology.processors); };
  const auto kind = random() % 3;  // 0: all processes have high priority, 1: low, 2: mixed
  const auto priority = [&] { return BOTH_PRIORITIES[kind < 2 ? kind : random() % 2]; };
  for (int tries = 3 * plan.topology.processors; tries > 0; --tries) {
    std::vector<int> path{pick()};
    for (const int to = pick(); path.back() != to;)
      path.push_back(std::ranges::find(neighbours[path.back()], routes.next_port(path.back(), to),
                                       &topologies::Neighbour::port)
                         ->processor);
    bool is_free = path.size() > 1;
    for (std::size_t i = 1; i < path.size(); ++i) is_free &= !taken[{path[i - 1], path[i]}];
    if (!is_free) continue;
    Stream stream;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i > 0) taken[{path[i - 1], path[i]}] = true;
      stream.stages.push_back({path[i],
                               random() % 2 == 0,
                               {priority(), priority()},
                               static_cast<std::int64_t>(random() % 3000)});
    }
    for (auto n = 1 + random() % 30; n > 0; --n)
      stream.lengths.push_back(1 + random() % (random() % 4 == 0 ? 2000 : 60));
    plan.streams.push_back(std::move(stream));
  }
  return plan;
}

// Makes some processes wait for their messages in ALTs with timeouts.
inline void let_some_poll(Plan& plan, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (Stream& stream : plan.streams)
    for (Stage& stage : stream.stages)
      if (random() % 2 == 0) stage.polls = 1 + static_cast<int>(random() % 40);
}

// Varies the machine: processors with two clock rates, some with companions, links with switches,
// PARs, and streams that begin late.
inline void make_different(Plan& plan, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < plan.topology.processors; ++i) plan.is_slow.push_back(random() % 2 == 0);
  for (std::size_t i = 0; i < plan.topology.links.size(); ++i)
    plan.switches.push_back(static_cast<int>(random() % 3));
  for (Stream& stream : plan.streams) {
    stream.begins = {1000 + 1e-6 * static_cast<double>(random() % 1000)};
    for (Stage& stage : stream.stages) {
      stage.in_par = random() % 2 == 0;
      stage.by_companion = random() % 2 == 0;
      // Makes processes wait longer, because an ALT on a slow processor may take more than a few
      // ticks.
      if (stage.polls > 0) stage.polls += 40;
    }
  }
}

inline Words poll(Channel<Words>& channel, int ticks) {
  std::optional<Words> message;
  Words arrived;
  while (!message)
    pri_alt(when(channel, arrived, [&] { message = arrived; }),
            after(read_timer() + ticks, [] { compute(50); }));
  return *message;
}

// Starts the processes of a stream. The last one records errors in `wrong` and arrivals in `log`.
inline void start_stream(Lab& lab, const Stream& stream, std::string& log, std::string& wrong) {
  const auto& cpus = lab.machine.processors();
  Channel<Words>* from = nullptr;
  for (std::size_t i = 0; i < stream.stages.size(); ++i) {
    const Stage& stage = stream.stages[i];
    Processor& cpu = *cpus[stage.processor];
    const bool last = i + 1 == stream.stages.size();
    Channel<Words>* to = last ? nullptr : &lab.hard(cpu, *cpus[stream.stages[i + 1].processor]);
    auto take = [&stream, &stage](Channel<Words>* channel, std::size_t n) {
      if (!channel) return Words{stream.lengths[n], n};
      return stage.polls > 0 ? poll(*channel, stage.polls) : channel->in();
    };
    auto give = [&](Channel<Words>* channel, std::size_t n, const Words& message) {
      if (channel) return out(*channel, message);
      if (message.content != n || message.length != stream.lengths[n])
        wrong += fmt::format("message {} is {}\n", n, message.content);
      log += fmt::format("{:a} ", own_cycles());
    };
    Channel<Words>*middle = stage.two ? &lab.soft() : nullptr, *back = middle;
    if (middle && stage.by_companion) {
      Processor& beside =
          cpu.companion() ? *cpu.companion() : lab.machine.add_companion(cpu, cpu.name() + "'s");
      middle = &lab.channels.emplace_back("there", cpu, beside);
      back = &lab.channels.emplace_back("back", beside, cpu);
      beside.start("relay", stage.priority[1], [=, &stream] {
        for (std::size_t n = 0; n < stream.lengths.size(); ++n) out(*back, middle->in());
      });
    }
    const auto first = [=, &stream, &stage] {
      if (stream.begins.value > 0) wait_until(ticks(stream.begins));
      for (std::size_t n = 0; n < stream.lengths.size(); ++n) {
        const Words message = take(from, n);
        compute(stage.computes);
        give(middle ? middle : to, n, message);
      }
      this_process().sync();
    };
    const auto second = [=, &stream] {
      for (std::size_t n = 0; n < stream.lengths.size(); ++n) give(to, n, back->in());
      this_process().sync();
    };
    if (middle && stage.in_par) {
      cpu.start("stage", stage.priority[0], [=, &stage] {
        par({{"first half", stage.priority[0], first}, {"second half", stage.priority[1], second}});
      });
    } else {
      cpu.start("stage", stage.priority[0], first);
      if (middle) cpu.start("second half", stage.priority[1], second);
    }
    from = to;
  }
}

inline void build_machine(Lab& lab, const Plan& plan) {
  Model slow = lab.machine.model();
  slow.cpu.clock = {slow.cpu.clock.value / 2};
  const auto slow_one = std::make_shared<const Model>(slow);
  for (int i = 0; i < plan.topology.processors; ++i)
    lab.machine.add_processor(fmt::format("cpu {}", i), 1 << 20, {},
                              !plan.is_slow.empty() && plan.is_slow[i] ? slow_one : nullptr);
  const auto& cpus = lab.machine.processors();
  for (std::size_t i = 0; i < plan.topology.links.size(); ++i) {
    const auto& link = plan.topology.links[i];
    lab.machine.connect(*cpus[link.a.processor], *cpus[link.b.processor],
                        plan.switches.empty() ? 0 : plan.switches[i]);
  }
}

}  // namespace occam

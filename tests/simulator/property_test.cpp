// What must always hold, over random machines: random topologies, crossed by streams of messages
// that random chains of processes relay.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "simulator/observe/use.hpp"
#include "tests/simulator/support.hpp"
#include "topologies/generators.hpp"
#include "topologies/routes.hpp"

namespace occam {
namespace {

// One processor on a stream's way. Two processes joined by a soft channel, or one.
struct Stage {
  int processor;
  bool two;
  Priority priority[2];
  std::int64_t computes;  // a message
};

struct Stream {
  std::vector<Stage> stages;
  std::vector<std::uint64_t> lengths;  // of its messages
};

struct Plan {
  topologies::Topology topology;
  std::vector<Stream> streams;  // no two on one link direction
};

Plan make_plan(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const char* const specs[] = {"line:5",    "ring:6",      "tree:10", "mesh:3x4",
                               "torus:3x3", "hypercube:4", "star:5"};
  Plan plan{topologies::make_generated(specs[seed % std::size(specs)]), {}};
  const auto routes = topologies::make_routes(plan.topology);
  const auto neighbours = topologies::neighbours(plan.topology);
  std::map<std::pair<int, int>, bool> taken;
  const auto pick = [&] { return static_cast<int>(random() % plan.topology.processors); };
  const auto kind = random() % 3;  // all high, all low, mixed
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

// What the plan costs, counted beside the simulator.
struct Counts {
  std::vector<std::int64_t> cycles;  // a processor, without switches
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> links;  // messages, bytes
};

std::string cpu_name(int processor) { return fmt::format("cpu {}", processor); }

Counts count(const Model& model, const Plan& plan) {
  Counts counts;
  counts.cycles.resize(plan.topology.processors);
  const auto blocked = model.channel.blocked.value;
  for (const Stream& stream : plan.streams)
    for (std::size_t i = 0; i < stream.stages.size(); ++i) {
      const Stage& stage = stream.stages[i];
      for (auto bytes : stream.lengths) {
        auto& cycles = counts.cycles[stage.processor];
        cycles += stage.computes + (stage.two ? blocked + soft_cost(model, bytes) : 0);
        if (i > 0) cycles += blocked;
        if (i + 1 == stream.stages.size()) continue;
        cycles += blocked;
        auto& link = counts.links[fmt::format("{} > {}", cpu_name(stage.processor),
                                              cpu_name(stream.stages[i + 1].processor))];
        ++link.first;
        link.second += bytes;
      }
    }
  return counts;
}

// Starts the processes of a stream. The sink notes what is wrong and when messages came.
void start_stream(Lab& lab, const Stream& stream, std::string& log, std::string& wrong) {
  const auto& cpus = lab.machine.processors();
  Channel<Words>* from = nullptr;
  for (std::size_t i = 0; i < stream.stages.size(); ++i) {
    const Stage& stage = stream.stages[i];
    Processor& cpu = *cpus[stage.processor];
    const bool last = i + 1 == stream.stages.size();
    Channel<Words>* to = last ? nullptr : &lab.hard(cpu, *cpus[stream.stages[i + 1].processor]);
    auto take = [&stream](Channel<Words>* channel, std::size_t n) {
      return channel ? channel->in() : Words{stream.lengths[n], n};
    };
    auto give = [&](Channel<Words>* channel, std::size_t n, const Words& message) {
      if (channel) return out(*channel, message);
      if (message.content != n || message.length != stream.lengths[n])
        wrong += fmt::format("message {} is {}\n", n, message.content);
      log += fmt::format("{:a} ", own_cycles());
    };
    Channel<Words>* middle = stage.two ? &lab.soft() : nullptr;
    cpu.start("stage", stage.priority[0], [=, &stream, &stage] {
      for (std::size_t n = 0; n < stream.lengths.size(); ++n) {
        const Words message = take(from, n);
        compute(stage.computes);
        give(middle ? middle : to, n, message);
      }
      this_process().sync();
    });
    if (middle)
      cpu.start("second half", stage.priority[1], [=, &stream] {
        for (std::size_t n = 0; n < stream.lengths.size(); ++n) give(to, n, middle->in());
        this_process().sync();
      });
    from = to;
  }
}

struct Result {
  std::string wrong, log;
};

void check_use(const Model& model, const Plan& plan, const machine::Machine& machine,
               std::string& wrong) {
  const Counts counts = count(model, plan);
  const observe::Use use = observe::collect(machine);
  const double clock = model.cpu.clock.value;
  for (std::size_t i = 0; i < use.cpus.size(); ++i) {
    const auto& cpu = use.cpus[i];
    const double switches = cpu.busy_s * clock - static_cast<double>(counts.cycles[i]);
    const auto n = static_cast<double>(cpu.preemptions);
    const auto there = static_cast<double>(model.scheduler.preemption.value);
    const auto back = static_cast<double>(model.scheduler.return_to_low.value);
    if (switches < n * there - 0.01 || switches > n * (there + back) + 0.01)
      wrong += fmt::format("{}: {} cycles beside {} charged, with {} pre-emptions\n", cpu.name,
                           switches, counts.cycles[i], n);
    if (cpu.busy_s > use.time_s * (1 + 1e-12)) wrong += cpu.name + " was busier than time\n";
  }
  for (const auto& link : use.links) {
    const auto found = counts.links.find(fmt::format("{} > {}", link.from, link.to));
    const auto [messages, bytes] =
        found == counts.links.end() ? std::pair<std::uint64_t, std::uint64_t>{} : found->second;
    if (link.messages != messages || link.bytes != bytes)
      wrong += fmt::format("{} > {}: {} bytes, not {}\n", link.from, link.to, link.bytes, bytes);
    const double least = static_cast<double>(bytes) / model.link.one_way_rate;
    const double most = static_cast<double>(bytes) / (model.link.both_ways_rate / 2);
    if (link.busy_s < least * (1 - 1e-9) || link.busy_s > most * (1 + 1e-9))
      wrong += fmt::format("{} > {}: busy {}, not within {} and {}\n", link.from, link.to,
                           link.busy_s, least, most);
  }
}

Result run_plan(const Plan& plan, const Model& model) {
  const auto text = isolated([&] {
    Lab lab(model);
    for (int i = 0; i < plan.topology.processors; ++i) lab.cpu();
    const auto& cpus = lab.machine.processors();
    for (const auto& link : plan.topology.links)
      lab.machine.connect(*cpus[link.a.processor], *cpus[link.b.processor]);
    std::deque<std::string> logs;
    std::string wrong, log;
    for (const Stream& stream : plan.streams) start_stream(lab, stream, logs.emplace_back(), wrong);
    lab.machine.run();
    check_use(model, plan, lab.machine, wrong);
    for (std::size_t i = 0; i < plan.streams.size(); ++i) {
      if (std::ranges::count(logs[i], ' ') != std::ssize(plan.streams[i].lengths))
        wrong += fmt::format("stream {} lost messages\n", i);
      log += logs[i] + "\n";
    }
    for (const auto& cpu : cpus) log += fmt::format("{:a} ", lab.busy_cycles(*cpu));
    return wrong + '|' + log;
  });
  const auto bar = text.find('|');
  return {text.substr(0, bar), text.substr(bar + 1)};
}

TEST(Machine, DeliversEveryMessageOnceInOrderAndAccountsForAllTime) {
  for (std::uint64_t seed = 0; seed < 42; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Plan plan = make_plan(seed);
    EXPECT_EQ(run_plan(plan, make_exact_model()).wrong, "");
  }
}

TEST(Machine, RepeatsItselfToTheLastBit) {
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Plan plan = make_plan(seed);
    const Model model = machine::load_model("t805-25");
    EXPECT_EQ(run_plan(plan, model).log, run_plan(plan, model).log);
  }
}

// One message through one chain, alone in the machine.
TEST(Machine, FasterClockOrLinkNeverMakesAnUnloadedLatencyLonger) {
  const Model slow = machine::load_model("t805-25");
  for (std::uint64_t seed = 200; seed < 214; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Plan plan = make_plan(seed);
    plan.streams.resize(1);
    plan.streams[0].lengths.resize(1);
    auto latency = [&](double clock, double rate) {
      Model model = slow;
      model.cpu.clock.value *= clock;
      model.link.one_way_rate *= rate;
      model.link.both_ways_rate *= rate;
      return std::strtod(run_plan(plan, model).log.c_str(), nullptr) / model.cpu.clock.value;
    };
    const double factors[] = {1, 1.1, 2, 10};
    for (std::size_t i = 1; i < std::size(factors); ++i) {
      constexpr double hair = 1 + 1e-12;
      EXPECT_LE(latency(factors[i], 1), latency(factors[i - 1], 1) * hair);
      EXPECT_LT(latency(1, factors[i]), latency(1, factors[i - 1]));
      EXPECT_LT(latency(factors[i], factors[i]), latency(factors[i - 1], factors[i]) * hair);
    }
  }
}

}  // namespace
}  // namespace occam

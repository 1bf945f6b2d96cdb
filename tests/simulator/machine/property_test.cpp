// Properties that all random machines must have.
#include <gtest/gtest.h>

#include "simulator/observe/use.hpp"
#include "tests/simulator/machine/random_machine.hpp"

namespace occam {
namespace {

// The cost of a plan, counted without the simulator.
struct Counts {
  std::vector<std::int64_t> cycles;  // cycles of each processor, without context switches
  // Numbers of messages and bytes, by name of the link direction.
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> links;
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

Result deliver_all(const Plan& plan, const Model& model) {
  const auto text = isolated([&] {
    Lab lab(model);
    build_machine(lab, plan);
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
    for (const auto& cpu : lab.machine.processors())
      log += fmt::format("{:a} ", lab.busy_cycles(*cpu));
    return wrong + '|' + log;
  });
  const auto bar = text.find('|');
  return {text.substr(0, bar), text.substr(bar + 1)};
}

TEST(Machine, DeliversEveryMessageOnceInOrderAndAccountsForAllTime) {
  for (std::uint64_t seed = 0; seed < 42; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Plan plan = make_plan(seed);
    EXPECT_EQ(deliver_all(plan, make_exact_model()).wrong, "");
  }
}

TEST(Machine, RepeatsItselfToTheLastBit) {
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Plan plan = make_plan(seed);
    const Model model = machine::load_model("t805-25");
    EXPECT_EQ(deliver_all(plan, model).log, deliver_all(plan, model).log);
  }
}

// A single message passes a chain of processors, alone in the machine.
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
      return std::strtod(deliver_all(plan, model).log.c_str(), nullptr) / model.cpu.clock.value;
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

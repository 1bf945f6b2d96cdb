// Dates of messages that are relayed while DMA slows the CPUs, compared with an independent
// simulation.
#include "tests/simulator/machine/dma_oracle.hpp"

#include <gtest/gtest.h>

#include "tests/simulator/machine/random_machine.hpp"

namespace occam {
namespace {

// Largest number of cycles computed for a message. The random numbers of cycles up to it are below
// and above Process::LONG_DEBT.
constexpr std::int64_t MOST_COMPUTED = 1500;
// Cycles that DMA takes for each word; links then take up to two thirds of a CPU.
constexpr double STOLEN = 10;

// A model with incommensurable rates, so that events can be simultaneous only if they have one
// cause.
Model make_slowed_model() {
  Model model = machine::override_model("t805-25", {{"instruction.fetch", 0.0}}, "tests");
  for (Cycles* beside : {&model.channel.operands, &model.channel.out_word}) *beside = {0};
  model.memory.steal_word = STOLEN;
  model.link.one_way_rate = 1.7340178e6;
  model.link.both_ways_rate = 2.3512911e6;
  return model;
}

Plan make_relays(std::uint64_t seed) {
  Plan plan = make_plan(seed);
  for (Stream& stream : plan.streams) {
    for (Stage& stage : stream.stages) {
      stage.two = false;
      stage.priority[0] = Priority::high;
      stage.computes = 1 + stage.computes % MOST_COMPUTED;
    }
  }
  return plan;
}

// Runs the plan. Returns the dates of arrival in seconds, stream by stream.
Numbers run_machine(const Plan& plan, machine::EngineParams engine) {
  return isolated_numbers([&] {
    Lab lab(make_slowed_model(), machine::Code::bare, engine);
    build_machine(lab, plan);
    std::vector<Numbers> arrived(plan.streams.size());
    const auto& cpus = lab.machine.processors();
    for (std::size_t s = 0; s < plan.streams.size(); ++s) {
      const Stream& stream = plan.streams[s];
      Channel<Words>* from = nullptr;
      for (std::size_t i = 0; i < stream.stages.size(); ++i) {
        const bool is_last = i + 1 == stream.stages.size();
        Processor& cpu = *cpus[stream.stages[i].processor];
        Channel<Words>* const to =
            is_last ? nullptr : &lab.hard(cpu, *cpus[stream.stages[i + 1].processor]);
        cpu.start("relay", Priority::high, [&, from, to, i, s] {
          for (const std::uint64_t length : stream.lengths) {
            if (from) from->in();
            compute(stream.stages[i].computes);
            if (to)
              out(*to, Words{length});
            else
              arrived[s].push_back(this_process().now().value);
          }
        });
        from = to;
      }
    }
    lab.machine.run();
    Numbers all;
    for (const Numbers& of_stream : arrived)
      all.insert(all.end(), of_stream.begin(), of_stream.end());
    return all;
  });
}

Numbers ask_oracle(const Plan& plan) {
  const Model model = make_slowed_model();
  std::vector<dma_oracle::Stream> streams;
  for (const Stream& stream : plan.streams) {
    auto& asked = streams.emplace_back();
    for (const Stage& stage : stream.stages)
      asked.relays.push_back({stage.processor, static_cast<double>(stage.computes)});
    for (const std::uint64_t length : stream.lengths)
      asked.lengths.push_back(static_cast<double>(length));
  }
  const dma_oracle::Machine machine{model.cpu.clock.value, model.link.one_way_rate,
                                    model.link.both_ways_rate, model.memory.steal_word / 4,
                                    static_cast<double>(model.channel.blocked.value)};
  Numbers all;
  for (const Numbers& of_stream :
       dma_oracle::Simulation(machine, plan.topology.processors, streams).run())
    all.insert(all.end(), of_stream.begin(), of_stream.end());
  return all;
}

TEST(DmaOracle, AgreesOnWhenRelayedMessagesArrive) {
  std::size_t messages = 0;
  for (std::uint64_t seed = 0; seed < 42; ++seed) {
    const Plan plan = make_relays(seed);
    const Numbers expected = ask_oracle(plan);
    for (const auto links : {machine::Links::simgrid, machine::Links::direct}) {
      const Numbers found = run_machine(plan, {.links = links});
      ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(found[i], expected[i], 1e-9 * expected[i])
            << "seed " << seed << ", message " << i
            << (links == machine::Links::direct ? ", direct" : ", SimGrid");
    }
    messages += expected.size();
  }
  EXPECT_GT(messages, 1000u);
}

// Like run_machine, but each stage of a stream has two processes: one inputs from the link, the
// other takes the message from a soft channel by an ALT. Both compute. If `pays`, each lets its
// computed cycles pass before it communicates. Returns the dates of arrival in seconds, by stream.
Numbers run_pairs(const Plan& plan, bool pays) {
  return isolated_numbers([&] {
    Lab lab(make_slowed_model(), machine::Code::bare, {.links = machine::Links::direct});
    build_machine(lab, plan);
    std::vector<Numbers> arrived(plan.streams.size());
    const auto& cpus = lab.machine.processors();
    const auto work = [pays](std::int64_t cycles) {
      compute(cycles);
      if (pays) this_process().sync();
    };
    for (std::size_t s = 0; s < plan.streams.size(); ++s) {
      const Stream& stream = plan.streams[s];
      Channel<Words>* from = nullptr;
      for (std::size_t i = 0; i < stream.stages.size(); ++i) {
        const bool is_last = i + 1 == stream.stages.size();
        const std::int64_t half = stream.stages[i].computes / 2;
        Processor& cpu = *cpus[stream.stages[i].processor];
        auto& inside = lab.soft();
        Channel<Words>* const to =
            is_last ? nullptr : &lab.hard(cpu, *cpus[stream.stages[i + 1].processor]);
        cpu.start("first", Priority::high, [&, from, half] {
          for (const std::uint64_t length : stream.lengths) {
            if (from) from->in();
            work(half);
            out(inside, Words{length});
          }
        });
        cpu.start("second", Priority::high, [&, to, half, s] {
          for (const std::uint64_t length : stream.lengths) {
            work(half);
            Words message;
            pri_alt(when(inside, message, [] {}));
            work(half);
            if (to)
              out(*to, Words{length});
            else
              arrived[s].push_back(this_process().now().value);
          }
        });
        from = to;
      }
    }
    lab.machine.run();
    Numbers all;
    for (const Numbers& of_stream : arrived)
      all.insert(all.end(), of_stream.begin(), of_stream.end());
    return all;
  });
}

// DMA must slow computations equally, whether their cycles are charged in advance or pass at once.
TEST(DmaOracle, DatesDoNotDependOnWhenAProcessPays) {
  for (std::uint64_t seed = 0; seed < 42; ++seed) {
    const Plan plan = make_relays(seed);
    const Numbers ahead = run_pairs(plan, false), paid = run_pairs(plan, true);
    ASSERT_FALSE(ahead.empty());
    ASSERT_EQ(ahead.size(), paid.size()) << "seed " << seed;
    for (std::size_t i = 0; i < ahead.size(); ++i)
      ASSERT_NEAR(ahead[i], paid[i], 1e-9 * paid[i]) << "seed " << seed << ", message " << i;
  }
}

}  // namespace
}  // namespace occam

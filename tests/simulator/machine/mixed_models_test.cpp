// Processors of different models in one machine, and several links between two processors.
#include <gtest/gtest.h>

#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

using machine::Code;
using machine::load_model;
using machine::Machine;

std::shared_ptr<const Model> share(const char* name) {
  return std::make_shared<const Model>(load_model(name));
}

// The duration of a computation must depend on the clock of its processor. For compiled occam, it
// must also depend on the factor of this processor.
TEST(MixedModels, EachProcessorHasItsOwnClockAndCosts) {
  const auto slow = share("t800-20");
  Model quick = load_model("t805-30");
  quick.software.occam_factor = 3;
  const auto found = isolated_numbers([&] {
    Machine machine(quick, Code::compiled, engine_under_test());
    Numbers ends(2);
    for (const bool is_slow : {false, true}) {
      auto& cpu =
          machine.add_processor(is_slow ? "slow" : "quick", 1 << 20, {}, is_slow ? slow : nullptr);
      auto& end = ends[is_slow];
      cpu.start("work", Priority::high, [&end] {
        compute(6000);
        end = this_process().now().value;
        charge(Cycles{600});
        end = this_process().now().value - end + 1000 * end;  // packs both times into one number
      });
    }
    machine.run();
    return ends;
  });
  EXPECT_NEAR(found.at(0), 1000 * 6000 / 30e6 + 3 * 600 / 30e6, 1e-9);
  EXPECT_NEAR(found.at(1), 1000 * 6000 / 20e6 + slow->software.occam_factor * 600 / 20e6, 1e-9);
}

// Time of a message between `a` and `b`, in either direction, in seconds from its start.
double time_between(const std::shared_ptr<const Model>& a, const std::shared_ptr<const Model>& b,
                    std::uint64_t bytes) {
  return isolated_numbers([&] {
           Machine machine(*a, Code::bare, engine_under_test());
           auto &here = machine.add_processor("a", 1 << 20),
                &there = machine.add_processor("b", 1 << 20, {}, b);
           machine.connect(here, there);
           Channel<Words> channel("c", machine.link(here, there));
           double start = 0;
           here.start("writer", Priority::high, [&] {
             wait_until_cycle(10'000);
             start = this_process().now().value;
             out(channel, {bytes});
           });
           there.start("reader", Priority::high, [&] { channel.in(); });
           machine.run();
           return Numbers{machine.now().value - start};
         })
      .at(0);
}

TEST(MixedModels, ALinkIsAsFastAsItsSlowerEnd) {
  const auto t414 = share("t414-20"), t800 = share("t800-20");
  const std::uint64_t bytes = 100'000;
  const double slow = time_between(t414, t414, bytes), quick = time_between(t800, t800, bytes);
  EXPECT_GT(slow, 1.5 * quick);
  EXPECT_NEAR(time_between(t414, t800, bytes), slow, 1e-5);
  EXPECT_NEAR(time_between(t800, t414, bytes), slow, 1e-5);
}

// Both ends lose the same number of cycles per word, so the one with the slower clock must lose a
// larger fraction of its time.
TEST(MixedModels, DmaTakesCyclesOfEachEndsOwnClock) {
  const auto slow = share("t800-20"), quick = share("t805-30");
  const auto lost_per_s = isolated_numbers([&] {
    Machine machine(*slow, Code::bare, engine_under_test());
    Numbers found(2);
    std::vector<machine::Processor*> cpus{&machine.add_processor("slow", 1 << 20),
                                          &machine.add_processor("quick", 1 << 20, {}, quick)};
    machine.connect(*cpus[0], *cpus[1]);
    Channel<Words> channel("c", machine.link(*cpus[0], *cpus[1]));
    cpus[0]->start("writer", Priority::high, [&] { out(channel, {1'000'000}); });
    cpus[1]->start("reader", Priority::high, [&] { channel.in(); });
    for (const bool is_quick : {false, true})
      cpus[is_quick]->start("work", Priority::low, [&found, is_quick] {
        constexpr std::int64_t CYCLES = 2'000'000;  // ends before the message does
        const double begun = this_process().now().value;
        this_process().charge(Cycles{CYCLES});
        const double took = this_process().now().value - begun;
        found[is_quick] = took * this_process().processor().clock().value - CYCLES;
        found[is_quick] /= took;
      });
    machine.run();
    return found;
  });
  const double words_per_s = slow->link.one_way_rate / 4;
  EXPECT_NEAR(lost_per_s.at(0), words_per_s * slow->memory.steal_word, 0.001 * words_per_s);
  EXPECT_NEAR(lost_per_s.at(1), words_per_s * quick->memory.steal_word, 0.001 * words_per_s);
}

TEST(MixedModels, LinksOfOneSpeedOnly) {
  Model half = machine::override_model("t805-25", {{"link.bit_rate", 10e6}}, "tests");
  half.name = "half";
  expect_failure("Misuse of a at 0",
                 {"the links of a (t805-25) run at 2", "those of b (half) at 1"}, [&](Lab& lab) {
                   auto& a = lab.machine.add_processor("a", 1, {}, share("t805-25"));
                   auto& b =
                       lab.machine.add_processor("b", 1, {}, std::make_shared<const Model>(half));
                   lab.machine.connect(a, b);
                 });
}

// Time of two messages in one direction, either on a link each or both on one link.
double time_of_two(int links, bool both_ways) {
  return isolated_numbers([&] {
           Lab lab(load_model("t805-25"));
           Processor &a = lab.cpu(), &b = lab.cpu();
           std::deque<Channel<Words>> channels;
           for (int i = 0; i < links; ++i) {
             lab.machine.connect(a, b);
             channels.emplace_back("there", lab.machine.link(a, b, static_cast<std::size_t>(i)));
             channels.emplace_back("back", lab.machine.link(b, a, static_cast<std::size_t>(i)));
           }
           const auto start = [&](Processor& from, Processor& to, std::size_t first) {
             for (std::size_t i = 0; i < static_cast<std::size_t>(links); ++i) {
               auto& channel = channels[2 * i + first];
               const int count = 2 / links;
               from.start("writer", Priority::high, [&channel, count] {
                 for (int n = 0; n < count; ++n) out(channel, {100'000});
               });
               to.start("reader", Priority::high, [&channel, count] {
                 for (int n = 0; n < count; ++n) channel.in();
               });
             }
           };
           start(a, b, 0);
           if (both_ways) start(b, a, 1);
           lab.machine.run();
           return Numbers{lab.machine.now().value};
         })
      .at(0);
}

TEST(SeveralLinks, CarryAsManyTimesAsMuch) {
  for (const bool both_ways : {false, true})
    EXPECT_NEAR(time_of_two(1, both_ways) / time_of_two(2, both_ways), 2, 0.001) << both_ways;
}

TEST(SeveralLinks, HaveNamesOfTheirOwnAndAreCutTogether) {
  EXPECT_EQ(isolated([] {
              Lab lab(load_model("t805-25"));
              Processor &a = lab.cpu(), &b = lab.cpu();
              for (int i = 0; i < 2; ++i) lab.machine.connect(a, b);
              std::string told;
              for (std::size_t i = 0; i < 2; ++i) told += lab.machine.link(a, b, i).name() + "; ";
              std::deque<Channel<Words>> channels;
              for (std::size_t i = 0; i < 2; ++i)
                channels.emplace_back("c", lab.machine.link(a, b, i));
              for (auto& channel : channels)
                a.start("writer", Priority::high,
                        [&] { told += out_or_fail(channel, Words{100'000}) ? "sent " : "lost "; });
              for (auto& channel : channels)
                b.start("reader", Priority::high,
                        [&] { told += in_or_fail(channel) ? "got " : "none "; });
              lab.machine.cut_link(a, b, {1e-3});
              lab.machine.run();
              return told;
            }),
            "cpu 0 > cpu 1; cpu 0 > cpu 1 (2); lost none lost none ");
}

}  // namespace
}  // namespace occam

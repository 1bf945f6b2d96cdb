// Effects of wait states and of workspaces in off-chip memory, and differences between models.
#include <gtest/gtest.h>

#include "tests/simulator/machine/random_machine.hpp"
#include "tests/support/lab.hpp"

namespace occam {
namespace {

Model make_model(const machine::Overrides& settings, const char* base = "t805-25") {
  return machine::override_model(base, settings, "tests");
}

Model make_waiting_model(int wait_states, bool off_chip) {
  machine::Overrides settings{{"memory.wait_states", double(wait_states)},
                              {"instruction.fetch", 0.0}};
  if (off_chip) settings.emplace_back("memory.workspace_word", "memory.external_word");
  return make_model(settings);
}

// Cycles of a rendezvous of `bytes` bytes on one processor, for both processes together.
double time_rendezvous(const Model& model, std::uint64_t bytes) {
  return isolated_numbers([&] {
           Lab lab(model);
           auto& channel = lab.soft();
           Processor& cpu = lab.cpu();
           cpu.start("reader", Priority::low, [&] { channel.in(); });
           cpu.start("writer", Priority::low, [&] { out(channel, {bytes}); });
           lab.machine.run();
           return Numbers{lab.cycles()};
         })
      .at(0);
}

// External memory takes 3 cycles and s wait states for an access. To copy a word, the CPU reads and
// writes it, in 2 (3 + s) cycles.
TEST(Memory, WaitStatesLengthenTheCopy) {
  for (int s : {0, 1, 2, 5})
    for (std::int64_t w : {2, 10, 1000}) {
      const Model model = make_waiting_model(s, false);
      EXPECT_NEAR(time_rendezvous(model, static_cast<std::uint64_t>(4 * w)),
                  (4 + 20) + (4 + 19) + w * 2 * (3 + s), ROUNDING);
      EXPECT_EQ(model.memory.steal_word, 3 + s - 1);
      // The workspace is on chip, so wait states must change the costs only of instructions that
      // access data in external memory, such as `load`.
      EXPECT_EQ(model.alternative.enable_not.value, 5 + 1 + 2 + 1);
      EXPECT_EQ(machine::get_instruction(model, "ldl").value, 2);
      EXPECT_EQ(machine::get_instruction(model, "load").value, 3 + (3 + s) - 1);
    }
}

// With the workspace off chip, a variable takes 3 + s cycles instead of one. An instruction that
// deschedules its process uses three variables.
TEST(Memory, WorkspacesOffChipLengthenEveryInstruction) {
  for (int s : {0, 1, 2}) {
    SCOPED_TRACE(fmt::format("{} wait states", s));
    const Model model = make_waiting_model(s, true);
    const int word = 3 + s, more = word - 1, deschedule = 3 * more;
    EXPECT_EQ(machine::get_instruction(model, "ldl").value, 1 + word);
    EXPECT_EQ(machine::get_instruction(model, "stl").value, word);
    EXPECT_EQ(machine::get_instruction(model, "lend").value, 10 + 4 * more);
    EXPECT_EQ(model.channel.operands.value, 1 + (1 + word) + 1);
    EXPECT_EQ(model.channel.blocked.value, 20 + deschedule);
    EXPECT_EQ(model.channel.soft_setup.value, 19 + deschedule);
    EXPECT_EQ(model.scheduler.start_process.value, 12 + deschedule);
    EXPECT_EQ(model.scheduler.end_process.value, 13 + deschedule);
    EXPECT_EQ(model.scheduler.run_process.value, 11 + deschedule);
    EXPECT_EQ(model.alternative.enable_not.value, 6 + (1 + word) + 1 + more);
    EXPECT_EQ(model.alternative.wait_not.value, 18 + deschedule);
    EXPECT_EQ(model.alternative.timer_wait_not.value, 49 + deschedule);
    EXPECT_EQ(model.alternative.disable.value, 9 + (1 + word) + 2 + more);
    EXPECT_EQ(model.timer.wait_future.value, 31 + (1 + word) + deschedule);
    const std::int64_t w = 5, operands = 3 + word;
    EXPECT_NEAR(time_rendezvous(model, 4 * w),
                (operands + 20 + deschedule) + (operands + 19 + deschedule + w * 2 * word),
                ROUNDING);
  }
}

// Slower memory must make no operation of any model cheaper.
TEST(Memory, NoRowIsLessWithMoreWaitStatesOrOffChip) {
  for (const auto& name : machine::builtin_models())
    for (bool off_chip : {false, true}) {
      Model last;
      for (int s = 0; s < 5; ++s) {
        machine::Overrides settings{{"memory.wait_states", double(s)}};
        if (off_chip) settings.emplace_back("memory.workspace_word", "memory.external_word");
        const Model model = make_model(settings, name.c_str());
        const Model& before = s > 0 ? last : machine::load_model(name);
        for (std::size_t i = 0; i < model.entries.size(); ++i) {
          EXPECT_EQ(model.entries[i].key, before.entries[i].key);
          EXPECT_GE(model.entries[i].value, before.entries[i].value) << model.entries[i].key;
        }
        last = model;
      }
    }
}

// Runs a random program. Returns its end and the busy time of each CPU.
Numbers run_plan(const Plan& plan, const Model& model) {
  return isolated_numbers([&] {
    Lab lab(model);
    build_machine(lab, plan);
    std::deque<std::string> logs;
    std::string wrong;
    for (const Stream& stream : plan.streams) start_stream(lab, stream, logs.emplace_back(), wrong);
    lab.machine.run();
    Numbers all{lab.machine.now().value};
    for (const auto& cpu : lab.machine.processors()) all.push_back(lab.busy_cycles(*cpu));
    return all;
  });
}

// There is one stream through a chain of processes, so a wait state can only delay what follows.
TEST(Memory, MoreWaitStatesAreNeverFaster) {
  for (std::uint64_t seed = 400; seed < 416; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Plan plan = make_plan(seed);
    plan.streams.resize(1);
    Numbers last(1 + plan.topology.processors);
    for (bool off_chip : {false, true})
      for (int s : {0, 1, 4}) {
        if (off_chip && s == 0) std::ranges::fill(last, 0);
        const auto found = run_plan(plan, make_waiting_model(s, off_chip));
        EXPECT_GE(found.at(0) * (1 + 1e-9), last.at(0)) << s << " wait states";
        last = found;
      }
  }
}

TEST(Memory, OffChipIsNeverFasterThanOnChip) {
  for (std::uint64_t seed = 400; seed < 410; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Plan plan = make_plan(seed);
    plan.streams.resize(1);
    const auto on_chip = run_plan(plan, make_on_chip_model()),
               data = run_plan(plan, make_waiting_model(0, false)),
               all = run_plan(plan, make_waiting_model(0, true));
    EXPECT_LE(on_chip.at(0), data.at(0) * (1 + 1e-9));
    EXPECT_LE(data.at(0), all.at(0) * (1 + 1e-9));
  }
}

// A slower model or a slower link must never make a random program with one stream faster. Tests
// four models and three link speeds.
TEST(Models, SlowerClocksAndLinksAreNeverFaster) {
  for (std::uint64_t seed = 500; seed < 508; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Plan plan = make_plan(seed);
    plan.streams.resize(1);
    plan.streams[0].lengths.resize(1);
    const auto time = [&](const char* base, const char* bit_rate) {
      return run_plan(plan, make_model({{"link.bit_rate", bit_rate}}, base)).at(0);
    };
    const char* const by_speed[] = {"t805-30", "t805-25", "t800-20", "t414-20"};
    for (int i = 1; i < 4; ++i)
      EXPECT_LT(time(by_speed[i - 1], "20e6"), time(by_speed[i], "20e6")) << by_speed[i];
    for (const char* model : by_speed) {
      EXPECT_LT(time(model, "20e6"), time(model, "10e6")) << model;
      EXPECT_LT(time(model, "10e6"), time(model, "5e6")) << model;
    }
  }
}

TEST(Models, DifferInWhatTheirFilesSay) {
  const auto difference = [](const char* a, const char* b) {
    return machine::describe_difference(machine::load_model(a), machine::load_model(b));
  };
  const auto holds = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const auto t800 = difference("t805-25", "t800-20");
  EXPECT_TRUE(holds(t800, "cpu.clock"));
  EXPECT_TRUE(holds(t800, "scheduler.slice"));
  EXPECT_FALSE(holds(t800, "link."));
  EXPECT_FALSE(holds(t800, "channel."));
  const auto t414 = difference("t800-20", "t414-20");
  EXPECT_TRUE(holds(t414, "link.one_way_rate"));
  EXPECT_TRUE(holds(t414, "instruction.add"));
  const auto clocks = fmt::format("{:<28} {:<28} {}\n", "cpu.clock", "25000000 Hz", "20000000 Hz");
  EXPECT_TRUE(holds(t800, clocks.c_str())) << t800;
  const auto none = difference("t805-25", "t805-25");
  const auto entries = machine::load_model("t805-25").entries.size();
  EXPECT_TRUE(holds(none, fmt::format("{} other entries are the same", entries).c_str())) << none;
}

}  // namespace
}  // namespace occam

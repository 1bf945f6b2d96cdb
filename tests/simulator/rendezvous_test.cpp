// Channels: when a rendezvous is over, what it costs, and what arrives.
#include <gtest/gtest.h>

#include "tests/simulator/support.hpp"

namespace occam {
namespace {

constexpr std::uint64_t LENGTHS[] = {1, 4, 5, 8, 100, 4001};
constexpr double HAIR = 1e-3;  // cycles; SimGrid resolves a picosecond

std::string name_of(Priority p) { return p == Priority::high ? "high" : "low"; }

struct SoftCase {
  bool writer_first;
  Priority first, second;
  std::uint64_t bytes;
};

std::vector<SoftCase> make_soft_cases() {
  std::vector<SoftCase> cases;
  for (bool writer_first : {true, false})
    for (auto first : BOTH_PRIORITIES)
      for (auto second : BOTH_PRIORITIES)
        for (auto bytes : LENGTHS) cases.push_back({writer_first, first, second, bytes});
  return cases;
}

// The first pays `blocked`, the second, who comes at `date`, set-up and copy; then both go on, and
// a high one pre-empts a low one.
TEST(SoftRendezvous, TakesTheSetupAndTheCopyOfTheSecondToCome) {
  constexpr std::int64_t date = 4096;
  const auto cases = make_soft_cases();
  const auto found = isolated_numbers([&] {
    Lab lab;
    std::deque<std::array<double, 3>> ends(cases.size());  // first, second, what was received
    for (std::size_t i = 0; i < cases.size(); ++i) {
      auto& channel = lab.soft();
      auto meet = [&, i](bool writes) {
        if (writes)
          out(channel, {cases[i].bytes, i});
        else
          ends[i][2] = static_cast<double>(channel.in().content);
      };
      Processor& cpu = lab.cpu();
      cpu.start("first", cases[i].first, [&, meet, i] {
        meet(cases[i].writer_first);
        ends[i][0] = own_cycles();
      });
      cpu.start("second", cases[i].second, [&, meet, i] {
        wait_until_cycle(date);
        meet(!cases[i].writer_first);
        ends[i][1] = own_cycles();
      });
    }
    lab.machine.run();
    Numbers all;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      all.insert(all.end(), ends[i].begin(), ends[i].end());
      all.push_back(lab.busy_cycles(*lab.machine.processors()[i]));
    }
    return all;
  });
  const Model model = make_exact_model();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& c = cases[i];
    SCOPED_TRACE(fmt::format("{} first, {} then {}, {} bytes", c.writer_first ? "writer" : "reader",
                             name_of(c.first), name_of(c.second), c.bytes));
    const bool preempts = c.first == Priority::high && c.second == Priority::low;
    const auto there = preempts ? model.scheduler.preemption.value : 0;
    const auto back = preempts ? model.scheduler.return_to_low.value : 0;
    const auto cost = soft_cost(model, c.bytes);
    EXPECT_EQ(found.at(4 * i), date + cost + there);
    EXPECT_EQ(found.at(4 * i + 1), date + cost + there + back);
    EXPECT_EQ(found.at(4 * i + 2), i);
    EXPECT_EQ(found.at(4 * i + 3),
              (model.timer.wait_future + model.channel.blocked).value + cost + there + back);
  }
}

TEST(SoftRendezvous, CompiledOccamMultipliesItsInstructions) {
  Model model = make_exact_model();
  model.software.occam_factor = 2.5;
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    double end = 0;
    auto& channel = lab.soft();
    Processor& cpu = lab.cpu();
    cpu.start("writer", Priority::low, [&] { out(channel, {8}); });
    cpu.start("reader", Priority::low, [&] {
      channel.in();
      compute(1000);  // computation has its own scales
      end = own_cycles();
      this_process().sync();
    });
    lab.machine.run();
    return Numbers{end};
  });
  const auto blocked = static_cast<double>(model.channel.blocked.value);
  const auto copy = static_cast<double>(soft_cost(model, 8));
  EXPECT_EQ(found.at(0), std::round(2.5 * blocked) + std::round(2.5 * copy) + 1000);
}

// On the machine `in` and `out` are one instruction each: whoever comes second copies. A high
// process may come while a low one is at its instruction, and is then first or second.
TEST(SoftRendezvous, IsCopiedWhenAHighProcessComesDuringTheInstructionOfALowOne) {
  constexpr std::uint64_t bytes = 4000;
  const Model model = make_exact_model();
  for (bool low_writes : {true, false}) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      auto& channel = lab.soft();
      auto meet = [&](bool writes) { writes ? out(channel, {bytes}) : void(channel.in()); };
      Processor& cpu = lab.cpu();
      cpu.start("high", Priority::high, [&] {
        wait_until_cycle(64);
        meet(!low_writes);
      });
      cpu.start("low", Priority::low, [&] {
        compute(64 - model.channel.blocked.value / 2 - model.timer.wait_future.value);
        meet(low_writes);
        this_process().sync();
      });
      lab.machine.run();
      return Numbers{lab.busy_cycles(cpu)};
    });
    EXPECT_GE(found.at(0), soft_cost(model, bytes)) << (low_writes ? "low writes" : "low reads");
  }
}

struct HardCase {
  bool reader_made_first, by_alt;
  Priority writer, reader;
  std::int64_t writer_computes, reader_computes;
  std::uint64_t bytes;
};

std::vector<HardCase> make_hard_cases(bool by_alt) {
  std::vector<HardCase> cases;
  for (bool reader_made_first : {false, true})
    for (auto writer : BOTH_PRIORITIES)
      for (auto reader : BOTH_PRIORITIES)
        for (auto [w, r] : {std::pair{0, 0}, {700, 0}, {0, 700}, {10, 700}})
          for (auto bytes : LENGTHS)
            cases.push_back({reader_made_first, by_alt, writer, reader, w, r, bytes});
  return cases;
}

// Both ends pay the start of their instruction; the later one starts the transfer.
double expected_end(const Model& model, const HardCase& c) {
  const auto& alt = model.alternative;
  const Cycles blocked = model.channel.blocked;
  const Cycles written = Cycles{c.writer_computes} + blocked;
  Cycles read = Cycles{c.reader_computes} + blocked;
  if (c.by_alt && written.value <= c.reader_computes)
    read += alt.setup + alt.enable_ready + alt.wait_ready + alt.disable + alt.end;
  else if (c.by_alt)
    read =
        std::max(written, Cycles{c.reader_computes} + alt.setup + alt.enable_not + alt.wait_not) +
        alt.disable + alt.end + blocked;
  return static_cast<double>(std::max(written, read).value) +
         static_cast<double>(c.bytes) / model.link.one_way_rate * model.cpu.clock.value;
}

void expect_hard_times(const std::vector<HardCase>& cases) {
  const auto found = isolated_numbers([&] {
    Lab lab;
    std::deque<std::array<double, 3>> ends(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      Processor& a = lab.cpu();
      Processor& b = lab.neighbour(a);
      auto& channel = cases[i].reader_made_first ? lab.hard(b, a) : lab.hard(a, b);
      auto write = [&, i] {
        compute(cases[i].writer_computes);
        out(channel, {cases[i].bytes, i});
        ends[i][0] = own_cycles();
      };
      auto read = [&, i] {
        compute(cases[i].reader_computes);
        Words got;
        cases[i].by_alt ? pri_alt(when(channel, got, [] {})) : in(channel, got);
        ends[i][1] = own_cycles();
        ends[i][2] = static_cast<double>(got.content);
      };
      if (cases[i].reader_made_first) a.start("reader", cases[i].reader, read);
      (cases[i].reader_made_first ? b : a).start("writer", cases[i].writer, write);
      if (!cases[i].reader_made_first) b.start("reader", cases[i].reader, read);
    }
    lab.machine.run();
    Numbers all;
    for (const auto& e : ends) all.insert(all.end(), e.begin(), e.end());
    return all;
  });
  const Model model = make_exact_model();
  std::string wrong;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& c = cases[i];
    const double end = expected_end(model, c), w = found.at(3 * i), r = found.at(3 * i + 1);
    if (std::abs(w - end) > HAIR || std::abs(r - end) > HAIR)
      wrong += fmt::format(
          "{} writer at {}, {} reader at {} made {}, {} bytes: ended at {} and {}, not {}\n",
          name_of(c.writer), c.writer_computes, name_of(c.reader), c.reader_computes,
          c.reader_made_first ? "first" : "second", c.bytes, w, r, end);
    EXPECT_EQ(found.at(3 * i + 2), i);
  }
  EXPECT_EQ(wrong, "");
}

TEST(HardRendezvous, StartsWhenBothEndsAreThereAndTakesBytesOverRate) {
  expect_hard_times(make_hard_cases(false));
}

// Whether the guard was ready is a matter of simulated times, not of who was created first.
TEST(HardRendezvous, AltReaderPaysItsInstructionsFirst) {
  expect_hard_times(make_hard_cases(true));
}

}  // namespace
}  // namespace occam

// Channels on a link: start and end of a transfer, and the message's contents.
#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

constexpr std::uint64_t LENGTHS[] = {0, 1, 4, 5, 8, 100, 4001};
constexpr double HAIR = 1e-3;  // tolerance in cycles, because SimGrid resolves only a picosecond

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

// The expected end of the transfer. Both processes pay for the operands and the start of their
// instruction; the later one starts the transfer. An ALT notices the output in one of three ways:
// when it enables the guard, at altwt, or because the output wakes it.
double expected_end(const Model& model, const HardCase& c) {
  const auto& alt = model.alternative;
  const auto written = c.writer_computes + cost_first(model, Side::writer, c.bytes);
  auto read = c.reader_computes;
  if (c.by_alt) {
    read += alt.setup.value;
    read += (written <= read ? alt.enable_ready : alt.enable_not).value;
    read += (written <= read ? alt.wait_ready : alt.wait_not).value;
    read = std::max(read, written) + (alt.disable + alt.end).value;
  }
  read += cost_first(model, Side::reader, c.bytes);
  return static_cast<double>(std::max(written, read)) +
         static_cast<double>(c.bytes) / model.link.one_way_rate * model.cpu.clock.value;
}

void expect_hard_times(const Model& model, const std::vector<HardCase>& cases) {
  const auto found = isolated_numbers([&] {
    Lab lab(model);
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
  expect_hard_times(make_exact_model(), make_hard_cases(false));
  expect_hard_times(make_complete_model(), make_hard_cases(false));
  expect_hard_times(machine::load_model("t805-25"), make_hard_cases(false));
  expect_hard_times(machine::load_model("t414-20"), make_hard_cases(false));
}

// Simulated times must determine if a guard is ready. The order of creating the processes must not
// matter.
TEST(HardRendezvous, AltReaderPaysItsInstructionsFirst) {
  expect_hard_times(make_exact_model(), make_hard_cases(true));
  expect_hard_times(machine::load_model("t805-25"), make_hard_cases(true));
}

// The output comes at any cycle of an ALT: before the ALT, while the guard is enabled, during
// altwt, or later. (If it comes in the very cycle in which the guard is checked, either order is
// possible.)
TEST(HardRendezvous, OutputMayComeAtAnyCycleOfAnAlt) {
  const Model model = make_complete_model();
  const auto& alt = model.alternative;
  const auto turn = 100 + alt.setup.value;
  std::vector<HardCase> cases;
  for (auto writer : BOTH_PRIORITIES)
    for (auto reader : BOTH_PRIORITIES)
      for (bool reader_made_first : {false, true})
        for (std::int64_t computes = 40; computes < 140; ++computes) {
          const auto written = computes + cost_first(model, Side::writer, 8);
          if (written != turn && written != turn + alt.enable_ready.value &&
              written != turn + alt.enable_not.value)
            cases.push_back({reader_made_first, true, writer, reader, computes, 100, 8});
        }
  expect_hard_times(model, cases);
}

// The process that comes second must also wait until the transfer ends: a writer in `out`, a reader
// in `in`.
TEST(HardRendezvous, EachEndWaitsInItsOwnDirection) {
  for (const bool writer_is_second : {false, true}) {
    const auto waited = isolated_numbers([&] {
      Lab lab(make_exact_model());
      Processor& a = lab.cpu();
      Processor& b = lab.neighbour(a);
      auto& channel = lab.hard(a, b);
      const auto& writer = a.start("writer", Priority::low, [&] {
        if (writer_is_second) compute(1000);
        out(channel, {400, 1});
      });
      const auto& reader = b.start("reader", Priority::low, [&] {
        if (!writer_is_second) compute(1000);
        Words got;
        in(channel, got);
      });
      lab.machine.run();
      Numbers cycles;
      for (const auto* process : {&writer, &reader})
        for (const auto kind : {machine::Wait::Kind::output, machine::Wait::Kind::input,
                                machine::Wait::Kind::alternative})
          cycles.push_back(process->blocked(kind).value * make_exact_model().cpu.clock.value);
      return cycles;
    });
    const auto model = make_exact_model();
    const double transfer = 400 / model.link.one_way_rate * model.cpu.clock.value;
    const double alone = 1000 + static_cast<double>(cost_first(model, Side::writer, 400) -
                                                    cost_first(model, Side::reader, 400));
    const double first = transfer + (writer_is_second ? alone : 2000 - alone);
    const Numbers expected = writer_is_second ? Numbers{transfer, 0, 0, 0, first, 0}
                                              : Numbers{first, 0, 0, 0, transfer, 0};
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(waited.at(i), expected[i], HAIR) << i << ", writer second " << writer_is_second;
  }
}

}  // namespace
}  // namespace occam

// ALT: the chosen guard, its time and cost. No message may be lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

constexpr int CHANNELS = 3;
constexpr std::int64_t LATE = 64 * 1024;  // at this cycle every writer is waiting

struct Choice {
  unsigned waiting, open;  // sets of channels: one bit for each channel
  int skip;                // place of SKIP among the guards; -1: no SKIP
};

// Makes all choices: every set of waiting writers, with every set of true conditions, and with SKIP
// at any place.
std::vector<Choice> make_choices() {
  std::vector<Choice> choices;
  for (unsigned waiting = 0; waiting < 1u << CHANNELS; ++waiting)
    for (unsigned open = 0; open < 1u << CHANNELS; ++open)
      for (int skip = -1; skip <= CHANNELS; ++skip)
        if (skip >= 0 || (waiting & open) != 0) choices.push_back({waiting, open, skip});
  return choices;
}

// The guards in order: numbers of channels, and -1 for SKIP.
std::vector<int> make_order(const Choice& c) {
  std::vector<int> order;
  for (int i = 0; i < CHANNELS; ++i) order.push_back(i);
  if (c.skip >= 0) order.insert(order.begin() + c.skip, -1);
  return order;
}

bool is_ready(const Choice& c, int guard) {
  return guard < 0 || (c.waiting & c.open & 1u << guard) != 0;
}

// The cycles of the instructions alt, enbc or enbs, altwt, disc or diss, altend, and in.
double expected_cost(const Model& model, const Choice& c, int taken) {
  const auto& alt = model.alternative;
  Cycles cost = alt.setup + alt.wait_ready + alt.end;
  for (int guard : make_order(c))
    cost += guard < 0 ? alt.enable_skip + alt.disable_skip
                      : (is_ready(c, guard) ? alt.enable_ready : alt.enable_not) + alt.disable;
  return static_cast<double>(cost.value + (taken < 0 ? 0 : soft_cost(model, 4)));
}

// Returns for each choice the chosen index, and the cycles from before the ALT until after the
// input.
Numbers run_choices(const std::vector<Choice>& choices, Priority priority) {
  return isolated_numbers([&] {
    Lab lab;
    Numbers found(2 * choices.size());
    for (std::size_t n = 0; n < choices.size(); ++n) {
      Processor& cpu = lab.cpu();
      std::array<Channel<Words>*, CHANNELS> channels;
      for (auto& channel : channels) channel = &lab.soft();
      for (int i = 0; i < CHANNELS; ++i)
        if ((choices[n].waiting & 1u << i) != 0)
          cpu.start("writer", Priority::low, [channel = channels[i]] { out(*channel, {4}); });
      cpu.start("reader", priority, [&, n, channels] {
        wait_until_cycle(LATE);
        std::vector<Guard> guards;
        const auto order = make_order(choices[n]);
        for (int i : order)
          guards.push_back(i < 0 ? Guard{} : Guard{channels[i], (choices[n].open >> i & 1u) != 0});
        const double before = own_cycles();
        const auto chosen = select(guards);
        if (order[chosen] >= 0) channels[order[chosen]]->in();
        found[2 * n] = static_cast<double>(chosen);
        found[2 * n + 1] = own_cycles() - before;
        for (int i = 0; i < CHANNELS; ++i)
          if (i != order[chosen] && (choices[n].waiting & 1u << i) != 0) channels[i]->in();
      });
    }
    lab.machine.run();
    return found;
  });
}

TEST(Alt, TakesTheFirstReadyGuardWhoseConditionHolds) {
  const auto choices = make_choices();
  for (auto priority : BOTH_PRIORITIES) {
    const auto found = run_choices(choices, priority);
    for (std::size_t n = 0; n < choices.size(); ++n) {
      const auto order = make_order(choices[n]);
      const auto first =
          std::ranges::find_if(order, [&](int g) { return is_ready(choices[n], g); });
      EXPECT_EQ(found.at(2 * n), first - order.begin())
          << fmt::format("waiting {:03b}, open {:03b}, skip at {}", choices[n].waiting,
                         choices[n].open, choices[n].skip);
    }
  }
}

TEST(Alt, CostsItsInstructionsAndTheInput) {
  const auto choices = make_choices();
  const auto found = run_choices(choices, Priority::high);
  const Model model = make_exact_model();
  std::set<double> excess_of_skip, excess_of_input;
  for (std::size_t n = 0; n < choices.size(); ++n) {
    const int taken = make_order(choices[n]).at(static_cast<std::size_t>(found.at(2 * n)));
    (taken < 0 ? excess_of_skip : excess_of_input)
        .insert(found.at(2 * n + 1) - expected_cost(model, choices[n], taken));
  }
  EXPECT_EQ(excess_of_skip, std::set<double>{0});
  EXPECT_EQ(excess_of_input, std::set<double>{0});
}

// Two writers output to channels of an ALT. The first output must wake the ALT; the second must
// wait for the next ALT. The channels may be soft or hard, and the writers may have charged cycles
// in advance. `dates` are the cycles of the outputs after LATE.
struct Wake {
  bool hard[2];
  Priority reader, writer;
  std::int64_t dates[2];
};

std::vector<Wake> make_wakes() {
  std::vector<Wake> wakes;
  for (bool a : {false, true})
    for (bool b : {false, true})
      for (auto reader : BOTH_PRIORITIES)
        for (auto writer : BOTH_PRIORITIES)
          for (auto [d, e] : {std::pair{0, 5000}, {5000, 0}, {0, 0}, {0, 10}, {10, 0}})
            wakes.push_back({{a, b}, reader, writer, {d, e}});
  return wakes;
}

TEST(Alt, IsWokenByTheFirstOfTwoWritersAndLosesNeither) {
  const auto wakes = make_wakes();
  const auto found = isolated_numbers([&] {
    Lab lab;
    Numbers got(2 * wakes.size());
    for (std::size_t n = 0; n < wakes.size(); ++n) {
      const Wake& wake = wakes[n];
      Processor& cpu = lab.cpu();
      std::array<Channel<Words>*, 2> channels;
      for (int i = 0; i < 2; ++i) {
        Processor& from = wake.hard[i] ? lab.neighbour(cpu) : cpu;
        channels[i] = wake.hard[i] ? &lab.hard(from, cpu) : &lab.soft();
        from.start("writer", wake.writer, [&wake, channel = channels[i], i] {
          wait_until_cycle(LATE);
          compute(wake.dates[i]);  // a high-priority process is then ahead of the clock
          out(*channel, {4, static_cast<std::uint64_t>(i)});
        });
      }
      cpu.start("reader", wake.reader, [&, n, channels] {
        for (std::size_t turn = 0; turn < 2; ++turn) {
          Words first, second;
          pri_alt(when(*channels[0], first, [&] { got[2 * n + turn] = 1 + first.content; }),
                  when(*channels[1], second, [&] { got[2 * n + turn] = 1 + second.content; }));
          compute(20'000);
          this_process().sync();
        }
      });
    }
    lab.machine.run();
    return got;
  });
  for (std::size_t n = 0; n < wakes.size(); ++n) {
    const Wake& w = wakes[n];
    SCOPED_TRACE(fmt::format("case {}: {} {}, dates {} {}", n, w.hard[0] ? "hard" : "soft",
                             w.hard[1] ? "hard" : "soft", w.dates[0], w.dates[1]));
    EXPECT_EQ(found[2 * n] + found[2 * n + 1], 3);  // the two inputs get both messages, each once
    // A writer on a soft channel computes on the reader's CPU, which may delay the reader.
    const bool apart = std::abs(w.dates[0] - w.dates[1]) > 100 && w.hard[0] && w.hard[1];
    if (apart) {
      EXPECT_EQ(found[2 * n], w.dates[0] < w.dates[1] ? 1 : 2);
    }
  }
}

// An ALT must wait for a guard whose condition is true, even if a guard whose condition is false
// has a message. It must take SKIP only if no earlier guard is ready.
TEST(Alt, WordsOfOccam) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Processor& cpu = lab.cpu();
    auto &closed = lab.soft(), &open = lab.soft();
    Numbers taken;
    cpu.start("reader", Priority::low, [&] {
      Words got;
      const auto note = [&] { taken.push_back(static_cast<double>(got.content)); };
      wait_until_cycle(4096);
      pri_alt(when(false, closed, got, note), when(open, got, note));
      for (int i = 0; i < 2; ++i)
        pri_alt(when(closed, got, note), otherwise(false, [&] { taken.push_back(-1); }),
                when(open, got, note), otherwise(true, [&] { taken.push_back(-2); }));
    });
    cpu.start("early", Priority::low, [&] { out(closed, {4, 1}); });
    cpu.start("late", Priority::low, [&] { compute(8000), out(open, {4, 2}); });
    lab.machine.run();
    return taken;
  });
  EXPECT_EQ(found, (Numbers{2, 1, -2}));
}

// A high-priority process has charged cycles in advance, so that it reaches its ALT at an own time
// ahead of the clock. Outputs that came before its own time must be ready.
TEST(Alt, AheadOfTheClockSeesTheOutputsThatCameBefore) {
  for (bool reader_first : {false, true})
    for (auto priority : BOTH_PRIORITIES) {
      const auto found = isolated_numbers([&] {
        Lab lab;
        Processor& a = lab.cpu();
        Processor& b = lab.neighbour(a);
        auto& channel = reader_first ? lab.hard(b, a) : lab.hard(a, b);
        double skipped = 0;
        (reader_first ? a : b).start("reader", priority, [&] {
          Words got;
          compute(5000);
          pri_alt(when(channel, got, [] {}), otherwise(true, [&] { skipped = 1; }));
          if (skipped != 0) channel.in();
        });
        (reader_first ? b : a).start("writer", Priority::low, [&] {
          compute(4000), out(channel, {});
        });
        lab.machine.run();
        return Numbers{skipped};
      });
      EXPECT_EQ(found.at(0), 0);
    }
}

// Writers compute for random times between their messages. The reader gives precedence to the
// writer after the one that it served last. Every waiting writer must be served within as many ALTs
// as there are channels.
std::string check_fairness(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto n = 1 + random() % 8;
  const auto work = 1 + random() % 3000;
  const auto reader_priority = BOTH_PRIORITIES[random() % 2];
  std::vector<std::uint64_t> messages(n);
  for (auto& count : messages) count = random() % 40;
  return isolated([&] {
    Lab lab;
    Processor& cpu = lab.cpu();
    std::vector<Processor*> neighbours;
    std::vector<Channel<Words>*> channels;
    for (std::size_t i = 0; i < n; ++i) {
      const bool hard = random() % 2 == 0 && neighbours.size() < 4;
      Processor& from = hard ? *neighbours.emplace_back(&lab.neighbour(cpu)) : cpu;
      channels.push_back(hard ? &lab.hard(from, cpu) : &lab.soft());
      const auto computes = static_cast<std::int64_t>(random() % work);
      from.start("writer", BOTH_PRIORITIES[random() % 2], [&, i, computes] {
        for (std::uint64_t m = 0; m < messages[i]; ++m) {
          compute(computes);
          out(*channels[i], {4 + 4 * (m % 7), m});
        }
      });
    }
    std::string wrong;
    cpu.start("reader", reader_priority, [&] {
      // Number of ALTs that each writer has waited for.
      std::vector<std::uint64_t> next(n), turns(n);
      std::uint64_t left = 0;
      for (auto count : messages) left += count;
      for (std::size_t favourite = 0; left > 0; --left) {
        this_process().sync();
        for (std::size_t i = 0; i < n; ++i)
          turns[i] = channels[i]->output_waits(this_process().now()) ? turns[i] + 1 : 0;
        Words got;
        const auto i = fair_alt(favourite, std::span<Channel<Words>* const>(channels), got);
        if (got.content != next[i]++) wrong += "out of order\n";
        if (turns[i] > n) wrong += fmt::format("{} served after {} turns\n", i, turns[i]);
        turns[i] = 0;
        favourite = (i + 1) % n;
      }
      if (next != messages) wrong += "a message was lost\n";
    });
    lab.machine.run();
    return wrong;
  });
}

TEST(Alt, FairChoiceServesWhoeverWaitsWithinATurnOfAll) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    EXPECT_EQ(check_fairness(seed), "");
  }
}

}  // namespace
}  // namespace occam

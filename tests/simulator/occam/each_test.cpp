// A replicated guard must take the same time, and make the same choice, as its guards written one
// by one.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

constexpr std::size_t INPUTS = 4;
constexpr int MESSAGES = 6;  // number of messages that each writer sends

// A reader notes three numbers for each message: from which input it came, its content, and the
// cycle at which it had been input.
using Reader = std::function<void(std::span<Channel<Words>* const>, Numbers&)>;

void note(Numbers& seen, std::size_t input, const Words& message) {
  seen.insert(seen.end(),
              {static_cast<double>(input), static_cast<double>(message.content), own_cycles()});
}

// Runs writers on the reader's processor and on neighbours. They compute for random times between
// their messages.
Numbers run(std::uint64_t seed, Priority priority, const Reader& reader) {
  std::mt19937_64 random(seed);
  return isolated_numbers([&] {
    Lab lab(machine::load_model("t805-25"));
    Processor& cpu = lab.cpu();
    std::vector<Channel<Words>*> channels;
    for (std::size_t i = 0; i < INPUTS; ++i) {
      Processor& from = random() % 2 == 0 ? lab.neighbour(cpu) : cpu;
      channels.push_back(&from == &cpu ? &lab.soft() : &lab.hard(from, cpu));
      const auto computes = static_cast<std::int64_t>(random() % 2000);
      from.start("writer", BOTH_PRIORITIES[random() % 2], [channels, i, computes] {
        for (std::uint64_t m = 0; m < MESSAGES; ++m) {
          compute(computes);
          out(*channels[i], {4 + 4 * (m % 7), 100 * i + m});
        }
      });
    }
    Numbers seen;
    cpu.start("reader", priority, [&] { reader(channels, seen); });
    lab.machine.run();
    return seen;
  });
}

// Reads by a PRI ALT. Input 0 has precedence over all others, and these take turns.
template <bool fair>
void read_by_each(std::span<Channel<Words>* const> inputs, Numbers& seen) {
  const auto rest = inputs.subspan(1);
  std::size_t favourite = 0;
  Words message;
  const auto take = [&](std::size_t i, const Words& input) {
    note(seen, i + 1, input);
    favourite = (i + 1) % rest.size();
  };
  auto first = when(*inputs[0], message, [&] { note(seen, 0, message); });
  for (std::size_t left = INPUTS * MESSAGES; left > 0; --left)
    if constexpr (fair)
      pri_alt(first, fair_each(rest, favourite, take), otherwise(false, [] {}));
    else
      pri_alt(first, each(rest, favourite, take), otherwise(false, [] {}));
}

// Reads with the PRI ALT of read_by_each(), but every guard is written separately. Each guard
// except the first costs a step of the replicator. If one of these guards is chosen, the address of
// its channel is computed again. With a fair choice, each address computation also costs a
// division. So does finding the next favourite.
template <bool fair>
void read_by_guards(std::span<Channel<Words>* const> inputs, Numbers& seen) {
  const auto& costs = this_process().processor().model().alternative;
  const std::size_t n = INPUTS - 1;
  std::size_t favourite = 0;
  for (std::size_t left = INPUTS * MESSAGES; left > 0; --left) {
    std::vector<Guard> guards{Guard(inputs[0])};
    for (std::size_t i = 0; i < n; ++i) {
      guards.emplace_back(inputs[1 + (favourite + i) % n]);
      guards.back().replicated = true;
      guards.back().is_fair = fair;
    }
    guards.emplace_back(nullptr, false);
    const std::size_t chosen = select(guards);
    const std::size_t input = chosen == 0 ? 0 : 1 + (favourite + chosen - 1) % n;
    if (chosen > 0) charge(fair ? costs.taken + costs.favourite : costs.taken);
    if (chosen > 0 && fair) this_process().charge(2 * costs.modulo);
    note(seen, input, inputs[input]->in());
    if (chosen > 0) favourite = input % n;
  }
}

TEST(Each, ChoosesAsGuardsWrittenOutDoAndCostsTheReplicatorsTurnsToo) {
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (const auto priority : BOTH_PRIORITIES) {
      const auto found = run(seed, priority, read_by_each<false>);
      EXPECT_EQ(found.size(), 3 * INPUTS * MESSAGES);
      EXPECT_EQ(found, run(seed, priority, read_by_guards<false>)) << seed;
      EXPECT_EQ(run(seed, priority, read_by_each<true>), run(seed, priority, read_by_guards<true>))
          << seed;
    }
}

TEST(Each, OfNoInputsLeavesTheOtherGuards) {
  const auto taken = isolated_numbers([] {
    Lab lab;
    double skipped = 0;
    lab.cpu().start("reader", Priority::low, [&] {
      const std::vector<Channel<Words>*> none;
      pri_alt(each(none, 0, [&](std::size_t, Words) { skipped = -1; }),
              otherwise(true, [&] { skipped = 1; }));
    });
    lab.machine.run();
    return Numbers{skipped};
  });
  EXPECT_EQ(taken, Numbers{1});
}

// Another kind of input for `each`, which adds a number to the content.
struct Numbered {
  Channel<Words>* channel;
  double number;
};
ChannelBase& channel_of(const Numbered& input) { return *input.channel; }
double input_from(const Numbered& input) {
  return static_cast<double>(input.channel->in().content) + input.number;
}

TEST(Each, TakesInputsOfOtherKindsByTheirOwnFunctions) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Processor& cpu = lab.cpu();
    const std::vector<Numbered> inputs{{&lab.soft(), 1000}, {&lab.soft(), 2000}};
    Numbers got;
    for (std::size_t i = 0; i < 2; ++i)
      cpu.start("writer", Priority::low, [&, i] { out(*inputs[i].channel, {4, 7 + i}); });
    cpu.start("reader", Priority::low, [&] {
      for (int left = 2; left > 0; --left)
        pri_alt(each(inputs, 1, [&](std::size_t, double value) { got.push_back(value); }));
    });
    lab.machine.run();
    return got;
  });
  EXPECT_EQ(found, (Numbers{2008, 1007}));
}

}  // namespace
}  // namespace occam

// Random programs with PARs, timeouts, soft and hard channels, computations and both priorities.
// They must end, lose no message, and account for every cycle.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

// Two processes with a channel. The writer computes and outputs. The reader takes each message by
// an input, or by an ALT with a timeout, which it repeats until the message comes.
struct Rendezvous {
  bool hard, by_alt, in_par;
  Priority writer, reader;
  int messages;
  // Computations in cycles; timeout in ticks.
  std::int64_t writer_computes, reader_computes, patience;
};

std::vector<Rendezvous> make_pairs(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Rendezvous> pairs;
  int hard = 0;
  for (auto n = 1 + random() % 8; n > 0; --n) {
    const bool is_hard = random() % 3 == 0 && hard < 2;
    hard += is_hard ? 1 : 0;
    pairs.push_back({is_hard, random() % 2 == 0, random() % 3 == 0, BOTH_PRIORITIES[random() % 2],
                     BOTH_PRIORITIES[random() % 2], static_cast<int>(1 + random() % 25),
                     static_cast<std::int64_t>(random() % 3000),
                     static_cast<std::int64_t>(random() % 3000),
                     static_cast<std::int64_t>(1 + random() % 20)});
  }
  return pairs;
}

struct Tally {
  int received = 0, timeouts = 0;
  std::string wrong;
};

void write_all(const Rendezvous& pair, Channel<Words>& channel) {
  for (int m = 0; m < pair.messages; ++m) {
    compute(pair.writer_computes);
    out(channel, {4 + static_cast<std::uint64_t>(m % 40), static_cast<std::uint64_t>(m)});
  }
}

void read_all(const Rendezvous& pair, Channel<Words>& channel, Tally& tally) {
  std::int64_t patience = pair.patience;
  for (int m = 0; m < pair.messages; ++m) {
    Words got;
    bool received = !pair.by_alt;
    if (received) in(channel, got);
    while (!received) {
      const auto deadline = read_timer() + patience;
      bool late = false;
      pri_alt(when(channel, got, [&] { received = true; }), after(deadline, [&] { late = true; }));
      if (late) {
        patience *= 2;  // a longer timeout leaves time for the other processes
        ++tally.timeouts;
        if (read_timer() < deadline) tally.wrong += "a timeout came early\n";
      }
    }
    if (got.content != static_cast<std::uint64_t>(m)) tally.wrong += "out of order\n";
    ++tally.received;
    compute(pair.reader_computes);
  }
}

// Starts a process of the pair. If pair.in_par, the process is a branch of a PAR in another
// process.
void start(Processor& cpu, const Rendezvous& pair, Priority priority, std::function<void()> body) {
  if (!pair.in_par) {
    cpu.start("process", priority, std::move(body));
    return;
  }
  cpu.start("parent", priority, [priority, body] {
    const auto other = priority == Priority::high ? Priority::low : Priority::high;
    par({{"beside", other, [] { compute(50); }}, {"branch", priority, body}});
  });
}

std::string run(std::uint64_t seed, const Model& model) {
  const auto pairs = make_pairs(seed);
  return isolated([&] {
    Lab lab(model);
    Processor& here = lab.cpu();
    Processor& there = lab.neighbour(here);
    std::deque<Tally> tallies;
    int hard = 0;
    for (const Rendezvous& pair : pairs) {
      // The second hard channel has the opposite direction.
      const bool forward = pair.hard && hard++ == 0;
      Processor& from = pair.hard ? (forward ? here : there) : here;
      Processor& to = pair.hard ? (forward ? there : here) : here;
      auto& channel = pair.hard ? lab.hard(from, to) : lab.soft();
      Tally& tally = tallies.emplace_back();
      start(from, pair, pair.writer, [&pair, &channel] { write_all(pair, channel); });
      start(to, pair, pair.reader, [&pair, &channel, &tally] { read_all(pair, channel, tally); });
    }
    lab.machine.run();
    std::string text;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      text += tallies[i].wrong;
      if (tallies[i].received != pairs[i].messages) text += "a message was lost\n";
    }
    for (const auto& cpu : lab.machine.processors()) {
      if (lab.busy_cycles(*cpu) > lab.cycles() * (1 + 1e-9)) text += "busier than time\n";
      for (const auto& process : cpu->processes())
        if (process->state() != Process::State::ended) text += "a process has not ended\n";
    }
    return text;
  });
}

TEST(RandomProgram, EndsAndLosesNothing) {
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    EXPECT_EQ(run(seed, make_exact_model()), "");
    EXPECT_EQ(run(seed, machine::load_model("t805-25")), "");
  }
}

}  // namespace
}  // namespace occam

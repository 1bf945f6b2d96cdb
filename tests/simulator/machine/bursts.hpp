// A low-priority process under random bursts of high-priority ones.
#pragma once

#include <random>

#include "tests/support/lab.hpp"

namespace occam {

struct Burst {
  std::int64_t date, cycles;
};

struct Load {
  std::int64_t low;  // cycles of one low process
  std::vector<Burst> bursts;
};

// Dates are ticks; low lengths are odd, so that nothing ends on one.
inline Load make_load(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto blocked = make_exact_model().channel.blocked.value;
  Load load{static_cast<std::int64_t>(random() % 60'000) * 2 + 1, {}};
  const auto spread = 1 << (4 + random() % 10);
  std::int64_t date = 4096;
  for (auto n = random() % 30; n > 0; --n) {
    date += static_cast<std::int64_t>(random() % spread) * 16 + 16;
    load.bursts.push_back({date, blocked + static_cast<std::int64_t>(random() % 2000) * 4});
  }
  return load;
}

struct Recorded {
  double low_end = 0;
  std::vector<double> burst_ends;
};

// Each burst's process then waits for a message from afar, so that it leaves the CPU ahead of the
// clock; its start is part of the burst.
inline void start_load(Lab& lab, Processor& cpu, const Load& load, Recorded& recorded) {
  recorded.burst_ends.resize(load.bursts.size());
  Processor& afar = lab.neighbour(cpu);
  std::vector<Channel<Words>*> releases;
  for (std::size_t i = 0; i < load.bursts.size(); ++i) {
    releases.push_back(&lab.hard(afar, cpu));
    cpu.start("burst", Priority::high, [&load, &recorded, i, release = releases[i]] {
      const auto blocked = this_process().processor().model().channel.blocked.value;
      wait_until_cycle(load.bursts[i].date);
      compute(load.bursts[i].cycles - blocked);
      recorded.burst_ends[i] = own_cycles() + static_cast<double>(blocked);
      release->in();
    });
  }
  afar.start("release", Priority::low, [releases] {
    wait_until_cycle(1 << 24);  // when all is over
    for (auto* channel : releases) out(*channel, Words{});
  });
  cpu.start("low", Priority::low, [&load, &recorded] {
    compute(load.low);
    this_process().sync();
    recorded.low_end = own_cycles();
  });
}

}  // namespace occam

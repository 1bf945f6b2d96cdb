// A low-priority process under random bursts of high-priority ones.
#pragma once

#include <random>

#include "tests/simulator/support.hpp"

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
  Load load{static_cast<std::int64_t>(random() % 60'000) * 2 + 1, {}};
  const auto spread = 1 << (4 + random() % 10);
  std::int64_t date = 4096;
  for (auto n = random() % 30; n > 0; --n) {
    date += static_cast<std::int64_t>(random() % spread) * 16 + 16;
    load.bursts.push_back({date, static_cast<std::int64_t>(random() % 2000) * 4});
  }
  return load;
}

struct Recorded {
  double low_end = 0;
  std::vector<double> burst_ends;
};

inline void start_load(Processor& cpu, const Load& load, Recorded& recorded) {
  recorded.burst_ends.resize(load.bursts.size());
  for (std::size_t i = 0; i < load.bursts.size(); ++i)
    cpu.start("burst", Priority::high, [&load, &recorded, i] {
      wait_until_cycle(load.bursts[i].date);
      compute(load.bursts[i].cycles);
      recorded.burst_ends[i] = own_cycles();
      this_process().sync();
    });
  cpu.start("low", Priority::low, [&load, &recorded] {
    compute(load.low);
    this_process().sync();
    recorded.low_end = own_cycles();
  });
}

}  // namespace occam

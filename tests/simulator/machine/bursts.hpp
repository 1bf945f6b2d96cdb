// A low-priority process on a CPU that random high-priority processes (bursts) interrupt.
#pragma once

#include <random>

#include "tests/support/lab.hpp"

namespace occam {

struct Burst {
  std::int64_t date, cycles;
};

struct Load {
  std::int64_t low;  // cycles that the low-priority process computes
  std::vector<Burst> bursts;
};

// Makes a random load for models with a whole number of cycles per tick. Lengths of low-priority
// computations are odd, so that none ends on a tick.
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

// Starts the processes of a load. The process of each burst ends by waiting for a message that
// never comes. It therefore gives up the CPU before the clock has reached the end of its charged
// cycles. The cycles that start this wait are counted as part of the burst.
inline void start_load(Lab& lab, Processor& cpu, const Load& load, Recorded& recorded) {
  recorded.burst_ends.resize(load.bursts.size());
  for (std::size_t i = 0; i < load.bursts.size(); ++i) {
    const auto body = [&load, &recorded, i, &never = lab.soft()] {
      const auto& model = this_process().processor().model();
      const auto blocked = model.channel.blocked.value;
      wait_until_cycle(load.bursts[i].date);
      compute(load.bursts[i].cycles - blocked);
      const double end = this_process().own_time().value * model.cpu.clock.value;
      recorded.burst_ends[i] = end + static_cast<double>(blocked);
      never.in();
    };
    cpu.start("burst", Priority::high, body).set_server();
  }
  // A process on another processor that ends after all others and so determines the end of the run.
  lab.cpu().start("end", Priority::low, [] { wait_until_cycle(1 << 24); });
  cpu.start("low", Priority::low, [&load, &recorded] {
    compute(load.low);
    this_process().sync();
    recorded.low_end = own_cycles();
  });
}

}  // namespace occam

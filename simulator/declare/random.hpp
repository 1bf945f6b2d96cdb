#pragma once
// Random numbers of a pattern, the same for the same seed on any machine (distributions of the
// standard library are not the same everywhere, its engines are).
#include <cmath>
#include <cstdint>
#include <random>

namespace programs {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // A stream of its own for each processor.
  Random(std::uint64_t seed, int processor)
      : engine_(seed * 1'000'003 + static_cast<std::uint64_t>(processor)) {}

  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }  // in (0, 1)
  double exponential() { return -std::log(uniform()); }                                // of mean 1
  int below(int n) { return static_cast<int>(uniform() * n); }
  // Any of `processors` but this one.
  int other_than(int processor, int processors) {
    return (processor + 1 + below(processors - 1)) % processors;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace programs

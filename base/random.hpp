#pragma once
// Reproducible random numbers: a seed gives the same numbers on every machine. The engines are
// those of the standard library. The distributions are our own, because those of the library differ
// between implementations.
#include <cmath>
#include <cstdint>
#include <random>

namespace base {

/// A counter-based random number. It depends only on `seed` and `counter`, so that numbers can be
/// computed in any order (SplitMix64, G. Steele et al. 2014).
inline std::uint64_t random_at(std::uint64_t seed, std::uint64_t counter) {
  std::uint64_t z = seed + (counter + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// A sequential generator of random numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Seeds a separate sequence of numbers for each processor of the simulated machine.
  Random(std::uint64_t seed, int processor)
      : engine_(seed * 1'000'003 + static_cast<std::uint64_t>(processor)) {}

  /// A random number uniformly distributed between 0 and 1, both excluded.
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  /// A random number with exponential distribution and mean 1.
  double exponential() { return -std::log(uniform()); }
  /// A random integer, uniformly distributed from 0 to n - 1.
  int below(int n) { return static_cast<int>(uniform() * n); }
  /// A random processor from 0 to `processors` - 1 other than `processor`.
  int other_than(int processor, int processors) {
    return (processor + 1 + below(processors - 1)) % processors;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace base

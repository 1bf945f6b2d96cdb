#pragma once
// Fuzzing of readers in child processes, with a report of the texts that make them fail.
#include <cstdint>
#include <functional>
#include <string>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

/// Limits for one case.
struct Limits {
  double cpu_s = 5;     ///< limit on the CPU time
  double wall_s = 120;  ///< limit on wall-clock time, for a reader that blocks
  /// limit on memory; unused with sanitizers, which need far more
  std::uint64_t memory_bytes = 2ull << 30;
};

struct Finding {
  std::uint64_t number = 0;  ///< number of the case
  std::string what;
};

struct Counts {
  std::uint64_t cases = 0, accepted = 0, refused = 0, findings = 0;
};

/// A reader, its corpus and its progress.
struct Trial {
  Reader reader;
  Corpus corpus;
  Counts counts = {};
  std::uint64_t next = 0;  ///< number of the next case
  double wall_s = 0;
};

/// Settings for all trials.
struct Campaign {
  using Tell = std::function<void(const Trial&, const Finding&)>;

  std::uint64_t seed = 1;
  Limits limits = {};
  Tell tell;  ///< called for each finding as soon as it occurs
};

/// Limit on the findings of a trial, since further ones are likely to be of the same kinds.
constexpr std::uint64_t MOST_FINDINGS = 20;

/// Makes the text of a case. It depends only on the reader's name, its corpus, the seed and the
/// number.
std::string make_case(const Trial& trial, std::uint64_t seed, std::uint64_t number);

/// Runs the next cases, at most `cases`, in a child process, up to the first failure. A reader
/// fails if it crashes, throws something other than base::BadInput, or exceeds the limits.
void run_batch(Trial& trial, std::uint64_t cases, const Campaign& campaign);

/// Runs each trial up to case number `cases`, or up to MOST_FINDINGS findings.
void run_number(std::vector<Trial>& trials, std::uint64_t cases, const Campaign& campaign);

/// Divides `hours` equally among all trials.
void run_hours(std::vector<Trial>& trials, double hours, const Campaign& campaign);

}  // namespace fuzz

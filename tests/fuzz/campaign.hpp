#pragma once
// Tests readers with many texts in child processes, and reports the texts that make them fail.
#include <cstdint>
#include <functional>
#include <string>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

/// Limits of a case.
struct Limits {
  double cpu_s = 5;                         ///< CPU time
  double wall_s = 120;                      ///< for a reader that waits
  std::uint64_t memory_bytes = 2ull << 30;  ///< without sanitizers, which need far more
};

struct Finding {
  std::uint64_t number = 0;  ///< of the case
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
  Tell tell;  ///< called immediately for each finding
};

/// A trial stops after this many findings: they are likely to be of few kinds.
constexpr std::uint64_t MOST_FINDINGS = 20;

/// The text of a case; depends on the reader's name, its corpus, the seed and the number.
std::string make_case(const Trial& trial, std::uint64_t seed, std::uint64_t number);

/// Runs the next cases, at most `cases`, in a child process, up to the first failure: the reader
/// crashes, throws something other than base::BadInput, or exceeds the limits.
void run_batch(Trial& trial, std::uint64_t cases, const Campaign& campaign);

/// Runs each trial up to case number `cases`, or to MOST_FINDINGS.
void run_number(std::vector<Trial>& trials, std::uint64_t cases, const Campaign& campaign);

/// Shares `hours` equally among all trials.
void run_hours(std::vector<Trial>& trials, double hours, const Campaign& campaign);

}  // namespace fuzz

#pragma once
// Fuzzing: calls readers with random texts in child processes, and reports texts that make them
// fail.
#include <cstdint>
#include <functional>
#include <string>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

/// Limits for one case.
struct Limits {
  double cpu_s = 5;     ///< limit on CPU time, seconds
  double wall_s = 120;  ///< limit on elapsed time, seconds, for a reader that blocks
  /// limit on memory; not used with sanitizers, which need far more
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

/// Settings that all trials share.
struct Campaign {
  using Tell = std::function<void(const Trial&, const Finding&)>;

  std::uint64_t seed = 1;
  Limits limits = {};
  Tell tell;  ///< called for each finding as soon as it is found
};

/// Limit on findings for each reader, because more of them would probably have the same causes.
constexpr std::uint64_t MOST_FINDINGS = 20;

/// Makes the text of a case. It depends only on the reader's name, the corpus, the seed, and the
/// number of the case.
std::string make_case(const Trial& trial, std::uint64_t seed, std::uint64_t number);

/// Executes the next cases, at most `cases`, in a child process, until the reader fails. A reader
/// fails if it crashes, throws anything but base::BadInput, or exceeds the limits.
void run_batch(Trial& trial, std::uint64_t cases, const Campaign& campaign);

/// Executes each trial up to the case with the number `cases`, or until it has MOST_FINDINGS
/// findings.
void run_number(std::vector<Trial>& trials, std::uint64_t cases, const Campaign& campaign);

/// Executes all trials, each for the same part of `hours`.
void run_hours(std::vector<Trial>& trials, double hours, const Campaign& campaign);

}  // namespace fuzz

#pragma once
// Runs readers with many texts in child processes, and says which of them they did not stand.
#include <cstdint>
#include <functional>
#include <string>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

/// What a case may take.
struct Limits {
  double cpu_s = 5;                         ///< of the processor
  double wall_s = 120;                      ///< for one that waits
  std::uint64_t memory_bytes = 2ull << 30;  ///< where no sanitizer watches, which needs far more
};

struct Finding {
  std::uint64_t number = 0;  ///< of the case
  std::string what;
};

struct Counts {
  std::uint64_t cases = 0, accepted = 0, refused = 0, findings = 0;
};

/// A reader, what it is tried with, and how far that is.
struct Trial {
  Reader reader;
  Corpus corpus;
  Counts counts = {};
  std::uint64_t next = 0;  ///< case
  double wall_s = 0;
};

/// How trials are made.
struct Campaign {
  using Tell = std::function<void(const Trial&, const Finding&)>;

  std::uint64_t seed = 1;
  Limits limits = {};
  Tell tell;  ///< is called for each finding, at once
};

/// A trial with so many findings is not continued: they are likely to be of few kinds.
constexpr std::uint64_t MOST_FINDINGS = 20;

/// The text of a case, which depends on the reader's name, its corpus, the seed and the number.
std::string make_case(const Trial& trial, std::uint64_t seed, std::uint64_t number);

/// Runs the next cases, at most `cases`, in a child process, up to the first that the reader does
/// not stand: it crashes, throws something else than base::BadInput, or goes beyond the limits.
void run_batch(Trial& trial, std::uint64_t cases, const Campaign& campaign);

/// Runs each trial up to a case, or to MOST_FINDINGS.
void run_number(std::vector<Trial>& trials, std::uint64_t cases, const Campaign& campaign);

/// Gives all trials the same time, together so many hours.
void run_hours(std::vector<Trial>& trials, double hours, const Campaign& campaign);

}  // namespace fuzz

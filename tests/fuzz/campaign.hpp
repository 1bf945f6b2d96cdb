#pragma once
// Runs a reader with many texts in child processes, and says which of them it did not stand.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/fuzz/readers.hpp"

namespace fuzz {

/// What a case may take.
struct Limits {
  double cpu_s = 5;                         ///< of the processor
  unsigned wall_s = 120;                    ///< for one that waits
  std::uint64_t memory_bytes = 2ull << 30;  ///< where no sanitizer watches, which needs far more
};

struct Finding {
  std::uint64_t number = 0;  ///< of the case
  std::string what;
};

struct Counts {
  std::uint64_t cases = 0, accepted = 0, refused = 0, findings = 0;
};

/// The text of a case, which depends on the reader's name, its corpus, the seed and the number.
std::string make_case(const Reader& reader, const Corpus& corpus, std::uint64_t seed,
                      std::uint64_t number);

/// Runs the cases first .. first + cases - 1 up to the first that the reader does not stand: it
/// crashes, throws something else than base::BadInput, or goes beyond the limits. Adds to `counts`.
std::optional<Finding> run_cases(const Reader& reader, const Corpus& corpus, std::uint64_t seed,
                                 std::uint64_t first, std::uint64_t cases, const Limits& limits,
                                 Counts& counts);

}  // namespace fuzz

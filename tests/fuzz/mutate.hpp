#pragma once
// Mutation: makes random texts from valid ones by a few changes.
#include <string>
#include <vector>

#include "base/random.hpp"

namespace fuzz {

/// The valid texts, and the words that occur in them.
struct Corpus {
  std::vector<std::string> texts;
  std::vector<std::string> words;
};

/// limit on the length of a text, bytes
inline constexpr std::size_t MAX_BYTES = 1 << 16;

/// Collects the words of the texts. Neither the list `texts` nor a text in it may be empty.
Corpus make_corpus(std::vector<std::string> texts);

/// Applies between zero and a dozen random changes to one of the texts: flips bits; sets bytes;
/// removes, doubles or repeats a part, or inserts one from another text; replaces the end by that
/// of another text; exchanges lines; replaces numbers and words. The result depends only on the
/// corpus and the random numbers.
std::string mutate(const Corpus& corpus, base::Random& random);

}  // namespace fuzz

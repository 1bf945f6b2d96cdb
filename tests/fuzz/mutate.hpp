#pragma once
// Inputs that are nearly right: valid texts with a few changes.
#include <string>
#include <vector>

#include "base/random.hpp"

namespace fuzz {

/// Texts to start from, and the words in them.
struct Corpus {
  std::vector<std::string> texts;
  std::vector<std::string> words;
};

/// Longest text that is generated, bytes.
inline constexpr std::size_t MAX_BYTES = 1 << 16;

/// `texts` must not be empty, nor any text in it.
Corpus make_corpus(std::vector<std::string> texts);

/// One of the texts with zero to a dozen changes: bits flipped, bytes set, parts removed, doubled,
/// repeated or inserted from another text, the end of another text, lines exchanged, numbers and
/// words replaced. The same stream gives the same text.
std::string mutate(const Corpus& corpus, base::Random& random);

}  // namespace fuzz

#pragma once
// Inputs that are nearly right: a few changes to one of several that are.
#include <string>
#include <vector>

#include "base/random.hpp"

namespace fuzz {

/// Texts to begin with, and the words that stand in them.
struct Corpus {
  std::vector<std::string> texts;
  std::vector<std::string> words;
};

/// Longest text that is made, bytes.
inline constexpr std::size_t MAX_BYTES = 1 << 16;

/// `texts` are not empty, nor is one of them.
Corpus make_corpus(std::vector<std::string> texts);

/// One of the texts with none to a dozen changes: bits flipped, bytes set, parts taken out,
/// doubled, repeated or put in from another text, the end of another text, lines exchanged, numbers
/// and words replaced. The same stream gives the same text.
std::string mutate(const Corpus& corpus, base::Random& random);

}  // namespace fuzz

#pragma once
// Mutation of texts: valid inputs with a few changes.
#include <string>
#include <vector>

#include "base/random.hpp"

namespace fuzz {

/// Texts to start from, and the words in them.
struct Corpus {
  std::vector<std::string> texts;
  std::vector<std::string> words;
};

/// Limit on the length of a generated text, bytes.
inline constexpr std::size_t MAX_BYTES = 1 << 16;

/// Neither `texts` nor any text in it may be empty.
Corpus make_corpus(std::vector<std::string> texts);

/// Applies zero to a dozen changes to one of the texts. Bits are flipped, bytes set; parts are
/// removed, doubled, repeated or inserted from another text; the end is taken from another text;
/// lines are exchanged; numbers and words are replaced. The same random stream yields the same
/// text.
std::string mutate(const Corpus& corpus, base::Random& random);

}  // namespace fuzz

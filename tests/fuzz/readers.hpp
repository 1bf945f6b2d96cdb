#pragma once
// The readers of files, with the properties of all that they accept.
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/mutate.hpp"

namespace fuzz {

/// A violated property of something that was read.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

struct Reader {
  std::string name;    ///< also the folder below tests/fuzz/corpus with its own texts
  std::string ending;  ///< of its files
  /// Folders below experiments/ and simulator/ whose files with this ending are also used.
  std::vector<std::string> folders;
  /// Reads a text. Throws base::BadInput to refuse it; any other exception is a defect. May write
  /// files in the current folder, which is its own.
  std::function<void(const std::string& text)> read;
  std::string corpus = {};  ///< reader that provides the texts, if another
};

/// All readers; names differ.
std::vector<Reader> all_readers();

/// The same for the program `tlab`, in its own process, with such files as arguments. These readers
/// write files in the current folder from the start.
std::vector<Reader> command_readers(const std::string& tlab);

/// The texts for a reader: its corpus and the project's own files.
Corpus load_corpus(const Reader& reader);

}  // namespace fuzz

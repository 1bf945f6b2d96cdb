#pragma once
// The fuzzed readers of files, and properties of everything that they accept.
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/mutate.hpp"

namespace fuzz {

/// A property that the result of a reader violates.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

struct Reader {
  std::string name;    ///< name, also of the folder below tests/fuzz/corpus with its own texts
  std::string ending;  ///< extension of the reader's files
  /// Folders below experiments/ and simulator/ whose files with this extension are also used.
  std::vector<std::string> folders;
  /// Reads a text. Throws base::BadInput to refuse it; any other exception is a defect. May write
  /// files in the current folder, which no other reader uses.
  std::function<void(const std::string& text)> read;
  std::string corpus = {};  ///< reader whose texts are used, if it is another one
};

/// All readers; their names are distinct.
std::vector<Reader> all_readers();

/// Makes readers that run the program `tlab` in its own process, with the texts as files. This call
/// itself writes files in the current folder.
std::vector<Reader> command_readers(const std::string& tlab);

/// Loads the texts for a reader: its corpus, and files of the project.
Corpus load_corpus(const Reader& reader);

}  // namespace fuzz

#pragma once
// The readers of files that are tested by fuzzing, with properties that every accepted text must
// have.
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/mutate.hpp"

namespace fuzz {

/// Thrown if the result of a reader lacks a property that it should have.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

struct Reader {
  /// name of the reader, and of the folder in tests/fuzz/corpus with texts for it
  std::string name;
  std::string ending;  ///< extension of the files that the reader reads
  /// folders below experiments/ and simulator/ whose files with this extension are used as texts
  /// too
  std::vector<std::string> folders;
  /// Reads a text. Refuses it by throwing base::BadInput; any other exception is a defect. May
  /// write files in the current folder, which no other reader uses.
  std::function<void(const std::string& text)> read;
  std::string corpus = {};  ///< name of another reader whose texts are used; "": the reader's own
};

/// All readers. Their names are different.
std::vector<Reader> all_readers();

/// Makes readers that execute the program `tlab` in a separate process. The program reads the texts
/// from files. Making the readers writes files into the current folder.
std::vector<Reader> command_readers(const std::string& tlab);

/// Loads the texts for a reader: its own corpus, and files of the project.
Corpus load_corpus(const Reader& reader);

}  // namespace fuzz

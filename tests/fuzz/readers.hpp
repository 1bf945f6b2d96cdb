#pragma once
// The readers of files, each with what must hold of whatever it accepts.
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/mutate.hpp"

namespace fuzz {

/// What must hold of something that was read and does not.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

struct Reader {
  std::string name;    ///< and the folder of tests/fuzz/corpus with texts of its own
  std::string ending;  ///< of its files
  /// Folders below experiments/ and simulator/ whose files with this ending it is tried with too.
  std::vector<std::string> folders;
  /// Reads a text. Throws base::BadInput to refuse it; anything else that it throws is a defect. It
  /// may make files in the current folder, which is its own.
  std::function<void(const std::string& text)> read;
  std::string corpus = {};  ///< name of the reader whose texts it is tried with, if another
};

/// All that there are; names differ.
std::vector<Reader> all_readers();

/// The same for the program `tlab`, in a process of its own, with files that it is given. They make
/// files in the current folder, now too.
std::vector<Reader> command_readers(const std::string& tlab);

/// The texts that a reader is tried with: those of its corpus and the project's own.
Corpus load_corpus(const Reader& reader);

}  // namespace fuzz

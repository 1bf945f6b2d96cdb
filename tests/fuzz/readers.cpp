#include "tests/fuzz/readers.hpp"

#include <algorithm>
#include <filesystem>

#include "base/whole_file.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

// limit on the length of corpus files, bytes; in a longer file, most changes would affect one of
// many similar lines, and test little
constexpr std::uintmax_t LONGEST = 4096;

// Adds the files in the order of their paths, so that a case depends only on their contents.
void add_files(const fs::path& folder, const std::string& ending, std::vector<std::string>& texts) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().string().ends_with(ending) &&
        entry.file_size() > 0 && entry.file_size() <= LONGEST)
      files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files) texts.push_back(base::read_text(file));
}

}  // namespace

std::string place_of(const std::string& path) {
  return (fs::path(TLAB_SOURCE_DIR) / path).string();
}

std::vector<Reader> all_readers() {
  std::vector<Reader> all;
  for (const auto& kind :
       {scene_readers(), network_readers(), text_readers(), result_readers(), picture_readers()})
    all.insert(all.end(), kind.begin(), kind.end());
  return all;
}

Corpus load_corpus(const Reader& reader) {
  std::vector<std::string> texts;
  const auto& name = reader.corpus.empty() ? reader.name : reader.corpus;
  add_files(place_of("tests/fuzz/corpus/" + name), "", texts);
  for (const auto& folder : reader.folders) add_files(place_of(folder), reader.ending, texts);
  if (texts.empty()) throw std::runtime_error(reader.name + ": no corpus");
  return make_corpus(std::move(texts));
}

}  // namespace fuzz

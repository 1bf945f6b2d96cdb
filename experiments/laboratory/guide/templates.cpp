#include "experiments/laboratory/guide/templates.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <regex>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/partial_name.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/guide/template_files.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

constexpr const char* TOKEN = "MINE";

// The template to which a file belongs: "farm" for "farm/MINE.toml".
std::string template_of(std::string_view path) {
  return std::string(path.substr(0, path.find('/')));
}

void check_name(const fs::path& name) {
  const auto last = name.filename().string();
  base::require(std::regex_match(last, std::regex("[A-Za-z][A-Za-z0-9_-]{0,99}")), "init",
                "found the name \"{}\", expected at most 100 letters, digits, - and _, beginning "
                "with a letter",
                last);
  base::require(!fs::exists(fs::symlink_status(name)), "init",
                "found {}, which already exists, expected a new name", name.string());
  const auto parent = name.parent_path();
  base::require(parent.empty() || fs::is_directory(parent), "init",
                "found {} in {}, which is not a folder, expected a folder", last, parent.string());
}

std::string rename_in(std::string_view text, const std::string& called) {
  return boost::replace_all_copy(std::string(text), TOKEN, called);
}

struct File {
  fs::path path;  // path of the file in the new folder
  std::string text;
};

std::vector<File> make_files(const std::string& from, const std::string& called) {
  std::vector<File> files;
  for (const auto& [path, text] : TEMPLATE_FILES)
    if (template_of(path) == from)
      files.push_back({rename_in(path.substr(from.size() + 1), called), rename_in(text, called)});
  return files;
}

}  // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const auto& [path, text] : TEMPLATE_FILES)
    if (std::ranges::find(names, template_of(path)) == names.end())
      names.push_back(template_of(path));
  return names;
}

std::vector<fs::path> start_from_template(const fs::path& name, const std::string& from) {
  const auto known = template_names();
  if (std::ranges::find(known, from) == known.end())
    throw base::BadInput(fmt::format("--from: found \"{}\"{}", from, base::suggest(from, known)));
  // "mine/" names the same folder as "mine"
  const auto folder = name.has_filename() ? name : name.parent_path();
  check_name(folder);
  const auto called = folder.filename().string();
  const auto working = folder.parent_path() / base::make_partial_name(called, "partial", getpid());
  const auto remove = [working] {
    std::error_code ignored;
    fs::remove_all(working, ignored);
  };
  const base::Undo undo(remove);
  std::vector<fs::path> made;
  try {
    fs::create_directory(working);
    for (const auto& file : make_files(from, called)) {
      base::save_whole(working / file.path, file.text);
      made.push_back(folder / file.path);
    }
    check_name(folder);  // another process may have made the folder meanwhile
    fs::rename(working, folder);
  } catch (...) {
    remove();
    throw;
  }
  return made;
}

}  // namespace laboratory

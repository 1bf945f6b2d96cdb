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

constexpr const char* TOKEN = "NAME";

// "farm" of "farm/NAME.toml"
std::string template_of(std::string_view path) {
  return std::string(path.substr(0, path.find('/')));
}

void check_name(const fs::path& name) {
  const auto last = name.filename().string();
  base::require(std::regex_match(last, std::regex("[A-Za-z][A-Za-z0-9_-]*")), "init",
                "found the name \"{}\", expected letters, digits, - and _, beginning with a letter",
                last);
  base::require(!fs::exists(fs::symlink_status(name)), "init",
                "found {}, which is there already, expected a new name", name.string());
}

std::string rename_in(std::string_view text, const std::string& called) {
  return boost::replace_all_copy(std::string(text), TOKEN, called);
}

void write_files(const fs::path& folder, const std::string& called, const std::string& from) {
  fs::create_directory(folder);
  for (const auto& [path, text] : TEMPLATE_FILES)
    if (template_of(path) == from)
      base::save_whole(folder / rename_in(path.substr(from.size() + 1), called),
                       rename_in(text, called));
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
  check_name(name);
  const auto called = name.filename().string();
  const auto working = name.parent_path() / base::make_partial_name(called, "partial", getpid());
  const auto remove = [working] {
    std::error_code ignored;
    fs::remove_all(working, ignored);
  };
  const base::Undo undo(remove);
  std::vector<fs::path> made;
  try {
    write_files(working, called, from);
    check_name(name);  // it may have come meanwhile
    fs::rename(working, name);
  } catch (...) {
    remove();
    throw;
  }
  for (const auto& [path, text] : TEMPLATE_FILES)
    if (template_of(path) == from)
      made.push_back(name / rename_in(path.substr(from.size() + 1), called));
  return made;
}

}  // namespace laboratory

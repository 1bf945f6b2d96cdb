#include "experiments/laboratory/points/origin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/host/version.hpp"

namespace laboratory {
namespace {

using base::BadInput;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

fs::path file_in(const fs::path& results) { return results / POINTS_ORIGIN; }

fs::path resolve(const fs::path& path) {
  std::error_code error;
  const auto resolved = fs::weakly_canonical(fs::absolute(path.empty() ? "." : path), error);
  if (error) throw BadInput(fmt::format("{}: {}", path.string(), error.message()));
  return resolved;
}

std::string name_of(const std::string& file) { return fs::path(file).stem().string(); }

std::string describe(const std::string& name, const std::string& title) {
  return title.empty() ? fmt::format("\"{}\"", name) : fmt::format("\"{}\" ({})", name, title);
}

// Finds the folder of the experiment file. If the recorded file name `file` still leads to this
// folder, returns the folder as spelled in `file`. Otherwise returns the path of `folder`, which is
// relative to the results folder.
fs::path find_folder(const fs::path& results, const std::string& file, const std::string& folder) {
  const fs::path spelled = fs::path(file).parent_path();
  const auto found = resolve(resolve(results) / folder);
  std::error_code error;
  const bool has_current = !fs::current_path(error).empty();  // false for a folder that was removed
  if (spelled.is_relative() && !has_current) return found;
  return resolve(spelled) == found ? spelled : found;
}

Origin read_origin(const fs::path& results, const ordered_json& json, const Overrides& more) {
  Origin origin;
  RunOptions& options = origin.options;
  options.file = json.at("file").get<std::string>();
  options.output = results.string();
  for (const auto& set : json.at("set"))
    options.overrides.push_back(parse_override(set.get<std::string>()));
  options.is_reduced = json.value("reduced", false);
  if (json.at("until_s").is_number()) options.until_s = json["until_s"].get<double>();
  const auto folder = find_folder(results, options.file, json.at("folder").get<std::string>());
  origin.file = load_experiment(
      {json.at("experiment").get<std::string>(), options.file, folder.string()}, more);
  return origin;
}

// Quotes a word that contains control characters, for the shells bash, zsh and ksh.
std::string spell_controls(const std::string& text) {
  std::string word = "$'";
  for (const char c : text)
    word += base::blank_controls({&c, 1}, '?') == std::string(1, c) && c != '\'' && c != '\\'
                ? std::string(1, c)
                : fmt::format("\\{:03o}", static_cast<unsigned char>(c));
  return word + "'";
}

// Quotes a word for a shell, if necessary.
std::string spell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("._-/=,:+").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  if (base::blank_controls(text) != text) return spell_controls(text);
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

fs::path results_folder(const RunOptions& options) {
  return options.output.empty() ? "results" / fs::path(options.file).stem()
                                : fs::path(options.output);
}

std::string command_line(const RunOptions& options) {
  std::string line = "tlab run " + spell_word(options.file);
  if (options.is_reduced) line += " --reduced";
  for (const auto& set : options.overrides) line += " --set " + spell_word(set.text());
  if (std::isfinite(options.until_s)) line += fmt::format(" --until {}", options.until_s);
  return line;
}

ordered_json make_origin(const RunOptions& options, const ExperimentFile& file,
                         const fs::path& results) {
  const auto folder = resolve(file.folder).lexically_relative(resolve(results)).string();
  base::require(base::is_utf8(folder), folder,
                "found a name that is not UTF-8, expected UTF-8 for run.json");
  auto set = ordered_json::array();
  for (const auto& override : options.overrides) set.push_back(override.text());
  return {
      {"tlab", VERSION},
      {"name", name_of(file.path)},
      {"title", file.points[0].experiment.title},
      {"file", file.path},
      {"folder", folder},
      {"set", set},
      {"reduced", options.is_reduced},
      {"until_s", std::isfinite(options.until_s) ? ordered_json(options.until_s) : ordered_json()},
      {"experiment", resolve(file)}};
}

void check_same_experiment(const fs::path& results, const ExperimentFile& file) {
  auto source = file_in(results);
  if (!fs::is_regular_file(source)) source = results / "run.json";
  if (!fs::is_regular_file(source)) return;
  const auto known = ordered_json::parse(base::read_own_text(source), nullptr, false);
  if (!known.is_object() || !known.contains("name")) return;
  const auto text = [&](const char* key) {
    return known.contains(key) && known[key].is_string() ? known[key].get<std::string>() : "";
  };
  const auto name = name_of(file.path), title = file.points[0].experiment.title;
  const auto folder = resolve(file.folder);
  const bool is_same_file = resolve(resolve(results) / text("folder")) == folder;
  if (text("name") == name && (is_same_file || text("title") == title)) return;
  throw BadInput(fmt::format(
      "{}: found results of the experiment {}, but this one is {}; expected another folder (-o)",
      results.string(), describe(text("name"), text("title")), describe(name, title)));
}

void save_origin(const fs::path& results, const ExperimentFile& file, const ordered_json& origin) {
  const auto path = file_in(results);
  const auto text = origin.dump(2) + "\n";
  const auto is_there = [&] {
    return fs::is_regular_file(path) && base::read_own_text(path) == text;
  };
  if (is_there()) return;
  check_same_experiment(results, file);
  make_folders(path.parent_path());
  if (!fs::exists(path) && base::save_new(path, text)) return;
  check_same_experiment(results, file);
  if (!is_there()) base::save_whole(path, text);
}

BadInput make_damaged(const fs::path& file, const nlohmann::json::exception& error) {
  const auto* parsing = dynamic_cast<const nlohmann::json::parse_error*>(&error);
  const auto found = parsing ? fmt::format("no JSON at byte {}", parsing->byte)
                             : std::string("JSON without members that tlab writes");
  return BadInput(fmt::format("{}: damaged: found {}, expected a file as tlab has written it",
                              file.string(), found));
}

Origin load_origin(const fs::path& results, const fs::path& file, const Overrides& overrides) {
  const auto path = results / file;
  base::require(fs::is_regular_file(path), results.string(),
                "found no {}, expected a results folder of tlab run", file.string());
  try {
    return base::at_place(path.string(), [&] {
      return read_origin(results, ordered_json::parse(base::read_own_text(path)), overrides);
    });
  } catch (const ordered_json::exception& error) {
    throw make_damaged(path, error);
  }
}

}  // namespace laboratory

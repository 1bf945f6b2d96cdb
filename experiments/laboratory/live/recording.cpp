#include "experiments/laboratory/live/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/toml.hpp"

namespace laboratory {

namespace {

namespace fs = std::filesystem;

// Changes file names in a TOML node from paths relative to the folder `from` to paths relative to
// `to`.
void move_files(toml::node& node, const fs::path& from, const fs::path& to) {
  if (auto* table = node.as_table())
    for (auto&& [key, value] : *table) move_files(value, from, to);
  if (auto* array = node.as_array())
    for (auto& value : *array) move_files(value, from, to);
  if (auto* text = node.as_string()) {
    std::error_code error;
    const auto file = fs::absolute(from / text->get());
    if (!fs::path(text->get()).has_extension() || !fs::is_regular_file(file, error)) return;
    *text = file.lexically_relative(fs::absolute(to)).string();
  }
}

struct Record {
  double at_s;
  std::string text;
};

Record to_record(const toml::node& node) {
  const auto* table = node.as_table();
  if (!table) return {};
  return {(*table)["at_s"].value_or(0.0), base::to_toml(*table)};
}

Record to_record(const UserAction& action) {
  std::string text = fmt::format("at_s = {}", action.at_s);
  for (const auto& [key, value] : action.keys) text += fmt::format("\n{} = {}", key, value);
  return {action.at_s, text};
}

}  // namespace

std::string record_session(const ExperimentFile& file, const std::vector<UserAction>& actions,
                           const std::string& folder) {
  toml::table table = *file.content;
  move_files(table, file.folder, folder);
  std::string lists;
  for (const char* key : {"order", "fault"}) {
    std::vector<Record> records;
    if (const auto* given = table[key].as_array())
      for (const auto& record : *given) records.push_back(to_record(record));
    for (const auto& action : actions)
      if (action.table == key) records.push_back(to_record(action));
    // The records must be in order of time, as the experiment file requires.
    std::ranges::stable_sort(records, {}, &Record::at_s);
    for (const auto& record : records) lists += fmt::format("\n[[{}]]\n{}\n", key, record.text);
    table.erase(key);
  }
  return base::to_toml(table) + "\n" + lists;
}

}  // namespace laboratory

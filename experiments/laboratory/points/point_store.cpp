#include "experiments/laboratory/points/point_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/errors.hpp"
#include "base/partial_name.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/host/version.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "renderer/files/load_scene.hpp"
#include "simulator/machine/engine.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// A hash that identifies this program, from its version, executable and SimGrid's version.
const std::string& program_id() {
  static const std::string id = hash_of(fmt::format(
      "{} {} {}", VERSION, hash_of(base::read_text("/proc/self/exe")), machine::simgrid_version()));
  return id;
}

// Formats the entries of a machine model. Models with equal entries give equal text, even if they
// come from different files.
std::string describe_entries(const ModelSpec& spec) {
  const auto model = make_model(spec);
  std::string text = model.base + "\n";
  for (const auto& e : model.entries)
    text +=
        fmt::format("{} = {} {} {}\n", e.key, e.value, e.unit, machine::to_string(e.provenance));
  return text;
}

// Finds the files to which a scene file refers. Skips unreadable files, which other code refuses.
std::vector<std::string> find_further_files(const std::string& path) {
  try {
    return renderer::find_files(path);
  } catch (const base::BadInput&) {
  }
  return {};
}

// Makes the end of a record: a hash of all text before it.
std::string make_seal(std::string_view text) {
  return fmt::format(",\"hash\":\"{}\"}}\n", hash_of(text));
}

// Reads a record. Returns null if it is damaged, or if its key is not the file's name. `filter` is
// the callback of nlohmann::json::parse.
ordered_json read_record(const fs::path& file, const ordered_json::parser_callback_t& filter) {
  const std::string text = base::read_own_text(file);
  const std::size_t end = make_seal("").size();
  if (text.size() < end) return {};
  const auto sealed = std::string_view(text).substr(0, text.size() - end);
  if (!text.ends_with(make_seal(sealed))) return {};
  auto record = ordered_json::parse(text, filter, false);
  return record.is_object() && record.value("key", "") == file.stem() ? record : ordered_json();
}

void remove_left_behind(const fs::path& folder) noexcept {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    const auto maker = base::find_maker(entry->path().filename().string(), "partial");
    if (maker && base::is_dead(*maker)) fs::remove(entry->path(), ignored);
  }
}

bool has_images(const PointResult& result, const fs::path& folder) {
  return std::ranges::all_of(result.images, [&](const SavedImage& image) {
    return fs::is_regular_file(folder / image.file) &&
           (image.exr.empty() || fs::is_regular_file(folder / image.exr));
  });
}

}  // namespace

std::vector<std::string> make_keys(const ExperimentFile& file, double until_s) {
  // hashes of models and files, each computed once for all points
  std::map<std::string, std::string> models, files;
  const auto describe_file = [&](const std::string& path) {
    auto& hash = files[path];
    if (hash.empty()) hash = fs::is_regular_file(path) ? hash_of(base::read_text(path)) : "none";
    return "\nfile " + hash;
  };
  std::vector<std::string> keys;
  for (const auto& [at, experiment, numbers] : file.points) {
    auto settings = file.keys;
    for (const auto& [axis, key, value] : at) settings[key] = value;
    std::string text = fmt::format("{}\nuntil {}\n", program_id(), until_s);
    for (const auto& [key, value] : spell_keys(settings))
      text += fmt::format("{} = {}\n", key, value);
    for_each_model(experiment, [&](const ModelSpec& spec) {
      auto& model = models[model_key(spec)];
      if (model.empty())
        model = base::at_place(file.path, [&] { return hash_of(describe_entries(spec)); });
      text += "model " + model;
    });
    for (const auto& source : files_of(experiment)) {
      text += describe_file(source);
      for (const auto& further : find_further_files(source)) text += describe_file(further);
    }
    keys.push_back(hash_of(text));
  }
  return keys;
}

fs::path records_folder() { return fs::path("points") / program_id().substr(0, 16); }
fs::path lone_records_folder() { return fs::path("points") / "lone"; }

std::optional<PointResult> find_record(const fs::path& results, const std::string& key) {
  const auto folder = results / records_folder(), file = folder / (key + ".json");
  if (!fs::is_regular_file(file)) return {};
  const auto skip_use = [](int depth, ordered_json::parse_event_t event, ordered_json& value) {
    return !(depth == 1 && event == ordered_json::parse_event_t::key && value == "use");
  };
  auto record = read_record(file, skip_use);
  if (record.is_null()) {
    complain(fmt::format("{}: this record is damaged and ignored", file.string()));
    return {};
  }
  auto result = to_result(record);
  return has_images(result, folder) ? std::optional(std::move(result)) : std::nullopt;
}

void save_record(const fs::path& folder, const std::string& key, const PointResult& result,
                 const std::string& at) {
  auto record = to_json(result);
  record["at"] = at;
  record["key"] = key;
  auto text = record.dump();
  text.pop_back();
  text += make_seal(text);
  try_twice([&] {
    make_folders(folder);
    base::save_whole(folder / (key + ".json"), text);
  });
}

PointResult load_record(const fs::path& file) {
  const auto record = read_record(file, nullptr);
  base::require(!record.is_null(), file.string(), "this record is damaged");
  return to_result(record);
}

StoreGuard::StoreGuard(const fs::path& results)
    : results_(fs::absolute(results)),
      records_(results_ / records_folder()),
      was_there_(fs::exists(results)),
      undo_([this] { clean_up(); }) {}

StoreGuard::~StoreGuard() {
  const base::Undivided section;
  clean_up();
}

void StoreGuard::clean_up() const noexcept {
  remove_left_behind(records_);
  remove_left_behind(records_.parent_path());
  std::error_code ignored;
  // has no effect on folders that still contain files, such as images of another process's records
  fs::remove(records_, ignored);
  fs::remove(records_.parent_path(), ignored);
  if (!was_there_) fs::remove(results_, ignored);
}

}  // namespace laboratory

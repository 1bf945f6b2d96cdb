#include "experiments/laboratory/points/point_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/errors.hpp"
#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/try_twice.hpp"
#include "experiments/laboratory/points/point_key.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// The end of a record: a hash of all that is before it.
std::string make_seal(std::string_view text) {
  return fmt::format(",\"hash\":\"{}\"}}\n", hash_of(text));
}

// A record, or null where its bytes are not those that were written, or it is of another key.
// `filter`: see nlohmann::json::parse.
ordered_json read_record(const fs::path& file, const ordered_json::parser_callback_t& filter) {
  const std::string text = read_file(file);
  const std::size_t end = make_seal("").size();
  if (text.size() < end) return {};
  const auto sealed = std::string_view(text).substr(0, text.size() - end);
  if (!text.ends_with(make_seal(sealed))) return {};
  auto record = ordered_json::parse(text, filter, false);
  return record.is_object() && record.value("key", "") == file.stem() ? record : ordered_json();
}

bool has_images(const ordered_json& record, const fs::path& folder) {
  const auto is_there = [&](const ordered_json& name) {
    return fs::is_regular_file(folder / name.get<std::string>());
  };
  if (record.contains("image") && !is_there(record["image"])) return false;
  for (const char* key : {"key_images", "images"})
    for (const auto& image : record.value(key, ordered_json::array()))
      if (!is_there(image["file"]) || (image.contains("exr") && !is_there(image["exr"])))
        return false;
  return true;
}

}  // namespace

fs::path records_folder() { return fs::path("points") / program_id().substr(0, 16); }
fs::path lone_records_folder() { return fs::path("points") / "lone"; }

std::optional<ordered_json> find_record(const fs::path& results, const std::string& key) {
  const auto folder = results / records_folder(), file = folder / (key + ".json");
  if (!fs::is_regular_file(file)) return {};
  const auto skip_use = [](int depth, ordered_json::parse_event_t event, ordered_json& value) {
    return !(depth == 1 && event == ordered_json::parse_event_t::key && value == "use");
  };
  auto record = read_record(file, skip_use);
  if (record.is_null()) {
    fmt::print(stderr, "tlab: {}: this record is damaged, the point is run again\n", file.string());
    return {};
  }
  if (!has_images(record, folder)) return {};
  return record;
}

void save_record(const fs::path& folder, const std::string& key, ordered_json record) {
  record["key"] = key;
  auto text = record.dump();
  text.pop_back();
  text += make_seal(text);
  try_twice([&] {
    fs::create_directories(folder);
    write_file(folder / (key + ".json"), text);
  });
}

ordered_json load_record(const fs::path& file) {
  auto record = read_record(file, nullptr);
  if (record.is_null())
    throw base::BadInput(fmt::format("{}: this record is damaged", file.string()));
  return record;
}

StoreGuard::StoreGuard(const fs::path& results)
    : results_(results), was_there_(fs::exists(results)) {}

StoreGuard::~StoreGuard() {
  std::error_code ignored;
  // What is not empty stays: images without records may be those of another process.
  fs::remove(results_ / records_folder(), ignored);
  fs::remove(results_ / records_folder().parent_path(), ignored);
  if (!was_there_) fs::remove(results_, ignored);
}

}  // namespace laboratory

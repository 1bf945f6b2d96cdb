#include "experiments/laboratory/points/point_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/carry.hpp"
#include "experiments/laboratory/host/hash.hpp"
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
  const std::string text = base::read_text(file);
  const std::size_t end = make_seal("").size();
  if (text.size() < end) return {};
  const auto sealed = std::string_view(text).substr(0, text.size() - end);
  if (!text.ends_with(make_seal(sealed))) return {};
  auto record = ordered_json::parse(text, filter, false);
  return record.is_object() && record.value("key", "") == file.stem() ? record : ordered_json();
}

bool has_images(const PointResult& result, const fs::path& folder) {
  return std::ranges::all_of(result.images, [&](const SavedImage& image) {
    return fs::is_regular_file(folder / image.file) &&
           (image.exr.empty() || fs::is_regular_file(folder / image.exr));
  });
}

}  // namespace

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
    fmt::print(stderr, "tlab: {}: this record is damaged, the point is run again\n", file.string());
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
    fs::create_directories(folder);
    base::save_whole(folder / (key + ".json"), text);
  });
}

PointResult load_record(const fs::path& file) {
  const auto record = read_record(file, nullptr);
  if (record.is_null())
    throw base::BadInput(fmt::format("{}: this record is damaged", file.string()));
  return to_result(record);
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

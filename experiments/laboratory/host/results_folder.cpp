#include "experiments/laboratory/host/results_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/host/carry.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, std::error_code error) {
  throw std::system_error(error, fmt::format("{}: {}", path.string(), what));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

// Makes a path absolute and resolves its links, so that the folder is replaced and not a link to
// it.
fs::path resolve(const fs::path& path) {
  if (path.empty()) throw base::BadInput("the name of a results folder is empty");
  auto resolved = fs::weakly_canonical(fs::absolute(path));
  return resolved.has_filename() ? resolved : resolved.parent_path();
}

void refuse(const fs::path& path, const std::string& found) {
  base::require(false, path.string(),
                "{}; expected a folder that is new, empty, or of earlier results (with a run.json "
                "or points)",
                found);
}

// Whether a folder holds nothing but files with names of ours.
template <class IsOurs>
bool has_only(const fs::path& folder, const IsOurs& is_ours) {
  return std::ranges::all_of(fs::directory_iterator(folder), [&](const auto& entry) {
    return entry.is_regular_file() && !entry.is_symlink() &&
           is_ours(entry.path().filename().string());
  });
}

bool is_plot(const std::string& name) { return name.ends_with(".svg") || name.ends_with(".png"); }

// Whether a file is of a record, be it whole or what a killed process has left of it.
bool is_of_record(const std::string& name) {
  return std::ranges::any_of(std::array{".json", ".png", ".exr", ".webp"},
                             [&](auto* part) { return name.find(part) != name.npos; });
}

// Whether a folder is the store of points' records.
bool is_store(const fs::path& folder) {
  return std::ranges::all_of(fs::directory_iterator(folder), [](const auto& entry) {
    if (entry.is_directory() && !entry.is_symlink()) return has_only(entry.path(), is_of_record);
    return entry.path().filename().string().find("experiment.json") != std::string::npos;
  });
}

// Whether `tlab` writes files like this one into a results folder; others are not ours.
bool is_result(const fs::path& entry) {
  static const std::vector<std::string> FILES{"results.csv", "checks.csv", "fits.csv",
                                              "best.csv",    "pays.csv",   "growth.csv",
                                              "run.json",    "report.html"};
  const auto name = entry.filename().string();
  if (fs::is_symlink(entry)) return false;
  if (fs::is_directory(entry))
    return name == "plots" || name == "networks" ? has_only(entry, is_plot)
                                                 : name == "points" && is_store(entry);
  return std::ranges::find(FILES, name) != FILES.end() ||
         (name.starts_with("image-") &&
          (entry.extension() == ".png" || entry.extension() == ".exr" ||
           entry.extension() == ".webp"));
}

void check_is_ours(const fs::path& path) {
  const auto status = fs::symlink_status(path);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) refuse(path, "is not a folder");
  const auto current = fs::current_path();
  const auto below = current.lexically_relative(path);
  if (!below.empty() && *below.begin() != "..") refuse(path, "holds the current folder");
  if (!fs::is_empty(path) && !fs::exists(path / "run.json") && !fs::exists(path / "points"))
    refuse(path, "holds files that are not results");
  for (const auto& entry : fs::directory_iterator(path))
    if (!is_result(entry.path()))
      refuse(path, fmt::format("holds {}, which would be lost", entry.path().filename().string()));
}

// Names this host: hosts may share the folder, and each knows only its own processes.
std::string host_name() {
  char name[HOST_NAME_MAX + 1] = {};
  if (gethostname(name, HOST_NAME_MAX) != 0) fail("gethostname", "no name", last_error());
  return name;
}

std::string partial_prefix(const fs::path& path) {
  return fmt::format(".{}.partial-{}-", path.filename().string(), host_name());
}
std::string old_prefix(const fs::path& path) {
  return fmt::format(".{}.old-{}-", path.filename().string(), host_name());
}

// Finds the process that made a folder of this name, if the name begins with `prefix`.
std::optional<pid_t> maker_of(const std::string& name, const std::string& prefix) {
  if (!name.starts_with(prefix)) return std::nullopt;
  const auto process = base::parse_number<pid_t>(std::string_view(name).substr(prefix.size()));
  return process && *process > 0 ? process : std::nullopt;
}

// Finds the folders that dead processes left. One with our own number is of an earlier process.
std::vector<fs::path> find_stale(const fs::path& path, const std::string& prefix) {
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(path.parent_path())) {
    const auto maker = maker_of(entry.path().filename().string(), prefix);
    if (!maker || !entry.is_directory() || entry.is_symlink()) continue;
    if (*maker == getpid() || (kill(*maker, 0) != 0 && errno == ESRCH))
      stale.push_back(entry.path());
  }
  return stale;
}

// Removes what dead processes left, except for results that they were replacing and records of
// points, which are put in place.
void remove_stale(const fs::path& path) {
  std::error_code ignored;
  for (const auto& folder : find_stale(path, old_prefix(path)))
    if (!fs::exists(path)) fs::rename(folder, path, ignored);
  for (const auto& prefix : {old_prefix(path), partial_prefix(path)})
    for (const auto& folder : find_stale(path, prefix)) {
      carry_records(folder, path);
      fs::remove_all(folder, ignored);
    }
}

// Removes the older results, after the records that other processes have added to them were carried
// over. What cannot be removed is left for a later run.
void drop_replaced(const fs::path& older, const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(older / "points")) {
    std::vector<fs::path> kept;
    for (const auto& entry : fs::directory_iterator(path / "points", ignored))
      if (entry.is_directory()) kept.push_back(entry.path().filename());
    for (const auto& name : kept)
      if (name != "lone") carry_files(older / "points" / name, path / "points" / name);
  }
  fs::remove_all(older, ignored);
}

// Moves the old folder aside and the new one in its place, where the two cannot be exchanged in one
// step. After a crash between the two the next run finds the old results under
// ".NAME.old-HOST-PID".
void replace_in_two_steps(const fs::path& working, const fs::path& path) {
  const auto aside = path.parent_path() / (old_prefix(path) + std::to_string(getpid()));
  std::error_code error, ignored;
  fs::rename(path, aside, error);
  if (error) fail(path, "cannot move earlier results aside", error);
  fs::rename(working, path, error);
  if (error) {
    fs::rename(aside, path, ignored);
    fail(path, "cannot put results in place", error);
  }
  drop_replaced(aside, path);
}

}  // namespace

void check_results_folder(const fs::path& path) { check_is_ours(resolve(path)); }

ResultsFolder::ResultsFolder(const fs::path& path) : path_(resolve(path)) {
  check_is_ours(path_);
  std::error_code error;
  for (auto parent = path_.parent_path(); !fs::exists(parent); parent = parent.parent_path())
    made_.push_back(parent);
  fs::create_directories(path_.parent_path(), error);
  if (error) fail(path_.parent_path(), "cannot make this folder", error);
  remove_stale(path_);
  const auto name = partial_prefix(path_) + std::to_string(getpid());
  const auto working = path_.parent_path() / name;
  if (!fs::create_directory(working, error)) fail(path_, "cannot write beside it", error);
  working_ = working;
}

ResultsFolder::~ResultsFolder() {
  std::error_code ignored;
  if (is_committed_) return;
  fs::remove_all(working_, ignored);
  for (const auto& parent : made_) fs::remove(parent, ignored);  // stays if it is not empty
}

void ResultsFolder::commit() {
  if (is_committed_) throw base::InvariantBroken(path_.string() + ": results committed twice");
  check_is_ours(path_);
  if (renameat2(AT_FDCWD, working_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
    is_committed_ = true;
    return drop_replaced(working_, path_);
  }
  if (errno == ENOENT) {
    if (std::rename(working_.c_str(), path_.c_str()) != 0)
      fail(path_, "cannot put results in place", last_error());
  } else if (errno == ENOSYS || errno == EINVAL || errno == ENOTSUP) {
    replace_in_two_steps(working_, path_);
  } else {
    fail(path_, "cannot put results in place", last_error());
  }
  is_committed_ = true;
}

}  // namespace laboratory

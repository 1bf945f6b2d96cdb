#include "experiments/laboratory/host/results_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <string>
#include <system_error>
#include <thread>

#include "base/errors.hpp"
#include "base/partial_name.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/link_files.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, std::error_code error) {
  throw std::system_error(error, fmt::format("{}: {}", path.string(), what));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

// Makes a path absolute and resolves its symbolic links. If the results folder is a link, the
// folder that it points to is replaced, not the link.
fs::path resolve(const fs::path& path) {
  if (path.empty()) throw base::BadInput("the name of a results folder is empty");
  std::error_code error;
  const auto resolved = fs::weakly_canonical(fs::absolute(path), error);
  if (error) throw base::BadInput(fmt::format("{}: {}", path.string(), error.message()));
  return resolved.has_filename() ? resolved : resolved.parent_path();
}

void refuse(const fs::path& path, const std::string& found) {
  base::require(
      false, path.string(),
      "{}; expected a new or empty folder, or one with earlier results (run.json or points)",
      found);
}

// True for files that desktop file managers create in folders.
bool is_of_desktop(const fs::path& entry) {
  const auto name = entry.filename().string();
  return (name == ".DS_Store" || name == "Thumbs.db" || name == "desktop.ini" ||
          name == ".directory") &&
         fs::is_regular_file(fs::symlink_status(entry));
}

// True if a folder contains only regular files whose names `is_ours` accepts, apart from files of
// the desktop.
template <class IsOurs>
bool has_only(const fs::path& folder, const IsOurs& is_ours) {
  return std::ranges::all_of(fs::directory_iterator(folder), [&](const auto& entry) {
    return is_of_desktop(entry.path()) || (entry.is_regular_file() && !entry.is_symlink() &&
                                           is_ours(entry.path().filename().string()));
  });
}

bool is_plot(const std::string& name) {
  return name.ends_with(".svg") || name.ends_with(".png") || name.ends_with(".pdf");
}

// True for a file of a point's record, complete or left behind by a killed process.
bool is_of_record(const std::string& name) {
  return std::ranges::any_of(std::array{".json", ".png", ".exr", ".webp"},
                             [&](auto* part) { return name.find(part) != name.npos; });
}

// True if a folder contains only records of points and the description of their experiment.
bool is_store(const fs::path& folder) {
  return std::ranges::all_of(fs::directory_iterator(folder), [](const auto& entry) {
    if (entry.is_directory() && !entry.is_symlink()) return has_only(entry.path(), is_of_record);
    const auto name = entry.path().filename().string();
    return name.find("experiment.json") != std::string::npos || is_of_desktop(entry.path());
  });
}

// True if `tlab` writes an entry of this name into results folders. Other entries belong to the
// user.
bool is_result(const fs::path& entry) {
  static const std::vector<std::string> FILES{
      "results.csv",  "results.schema.json", "checks.csv",    "fits.csv",      "best.csv",
      "pays.csv",     "growth.csv",          "histogram.csv", "intervals.csv", "assumptions.csv",
      "rankings.csv", "means.csv",           "run.json",      "report.html"};
  const auto name = entry.filename().string();
  if (fs::is_symlink(entry)) return false;
  if (is_of_desktop(entry)) return true;
  if (fs::is_directory(entry))
    return name == "plots" || name == "networks" || name == "figures"
               ? has_only(entry, is_plot)
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
  std::error_code error;  // the current folder may have been removed; then it is in no folder
  const auto current = fs::current_path(error);
  const auto below = current.lexically_relative(path);
  if (!below.empty() && *below.begin() != "..") refuse(path, "holds the current folder");
  if (!fs::is_empty(path) && !fs::exists(path / "run.json") && !fs::exists(path / "points"))
    refuse(path, "holds files that are not results");
  for (const auto& entry : fs::directory_iterator(path))
    if (!is_result(entry.path()))
      refuse(path, fmt::format("holds {}, which would be lost", entry.path().filename().string()));
}

// Throws if replacing `path` would destroy a file that the command reads, such as a texture whose
// name looks like that of a result. Files that are in `working` too, as hard links, are safe.
void check_inputs_survive(const fs::path& path, const fs::path& working) {
  if (!fs::exists(path)) return;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (working.empty() ||
        !fs::equivalent(entry.path(), working / entry.path().lexically_relative(path), ignored))
      base::check_no_input(entry.path());
}

// Kinds of hidden folders beside `path`: "partial" for unfinished results, "old" for older results
// that were moved aside.
constexpr const char *PARTIAL = "partial", *OLD = "old";

fs::path beside(const fs::path& path, const char* kind) {
  return path.parent_path() / base::make_partial_name(path.filename().string(), kind, getpid());
}

// Finds the hidden folders of processes that no longer run. A folder with the number of the current
// process is also one of these: an earlier process had the same number.
std::vector<fs::path> find_stale(const fs::path& path, const char* kind) {
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(path.parent_path())) {
    const auto name = entry.path().filename().string();
    const auto maker = base::find_maker(name, kind);
    if (!maker || !entry.is_directory() || entry.is_symlink()) continue;
    if (name != base::make_partial_name(path.filename().string(), kind, *maker)) continue;
    if (*maker == getpid() || base::is_dead(*maker)) stale.push_back(entry.path());
  }
  return stale;
}

// Removes a folder into which another thread or a dying child process may still write. A removal
// fails if files appear or vanish meanwhile, so it is retried.
void remove_surely(const fs::path& folder) {
  constexpr int TRIES = 1000;
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  for (int i = 1; i < TRIES && fs::exists(folder, ignored); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    fs::remove_all(folder, ignored);
  }
}

// Removes the hidden folders of dead processes, but keeps the records of points. If a process died
// after it had moved older results aside and before it had put new ones in place, moves the older
// results back.
void remove_stale(const fs::path& path) {
  std::error_code ignored;
  for (const auto& folder : find_stale(path, OLD))
    if (!fs::exists(path)) fs::rename(folder, path, ignored);
  for (const auto* kind : {OLD, PARTIAL})
    for (const auto& folder : find_stale(path, kind)) {
      link_records(folder, path);
      fs::remove_all(folder, ignored);
    }
}

// Removes results that were replaced. First moves the records that other processes have added to
// them into the new results. Leaves files that it cannot remove to a later run.
void drop_replaced(const fs::path& older, const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(older / "points")) {
    std::vector<fs::path> kept;
    for (const auto& entry : fs::directory_iterator(path / "points", ignored))
      if (entry.is_directory()) kept.push_back(entry.path().filename());
    for (const auto& name : kept)
      if (name != "lone") link_files(older / "points" / name, path / "points" / name);
  }
  fs::remove_all(older, ignored);
}

void check_replaced(const fs::path& path, const ResultsFolder::Check& check) {
  check_is_ours(path);
  if (check) check(path);
}

// Moves the old folder aside, and then the new one into its place. Used on file systems without an
// atomic exchange. After a crash between the two steps, the next run finds the old results under
// ".NAME.old-HOST-PID".
void replace_in_two_steps(const fs::path& working, const fs::path& path,
                          const ResultsFolder::Check& check) {
  const auto aside = beside(path, OLD);
  std::error_code error, ignored;
  fs::rename(path, aside, error);
  if (error) fail(path, "cannot move earlier results aside", error);
  try {
    check_replaced(aside, check);
    fs::rename(working, path, error);
    if (error) fail(path, "cannot move results into place", error);
  } catch (const std::exception&) {
    fs::rename(aside, path, ignored);
    check_replaced(path, check);  // throws an error that names `path`
    throw;
  }
  drop_replaced(aside, path);
}

bool rename_with(unsigned flags, const fs::path& from, const fs::path& to) {
  return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0;
}

bool is_unable(int error) { return error == ENOSYS || error == EINVAL || error == ENOTSUP; }

// Moves the folder `working` to `path`. Returns false if something exists at `path` meanwhile.
bool put_in_place(const fs::path& working, const fs::path& path) {
  if (rename_with(RENAME_NOREPLACE, working, path)) return true;
  if (errno == EEXIST) return false;
  if (is_unable(errno) && std::rename(working.c_str(), path.c_str()) == 0) return true;
  fail(path, "cannot move results into place", last_error());
}

}  // namespace

void check_results_folder(const fs::path& path) {
  const auto resolved = resolve(path);
  check_is_ours(resolved);
  check_inputs_survive(resolved, {});
}

ResultsFolder::ResultsFolder(const fs::path& path) : path_(resolve(path)) {
  check_is_ours(path_);
  const base::Undivided section;
  for (auto parent = path_.parent_path(); !fs::exists(parent); parent = parent.parent_path())
    made_.push_back(parent);
  try {
    make_working();
  } catch (const std::exception&) {
    clean_up();
    throw;
  }
  undo_.emplace([this] { clean_up(); });
}

void ResultsFolder::make_working() {
  std::error_code error;
  fs::create_directories(path_.parent_path(), error);
  if (error) fail(path_.parent_path(), "cannot create this folder", error);
  remove_stale(path_);
  const auto working = beside(path_, PARTIAL);
  if (!fs::create_directory(working, error))
    fail(path_, "cannot write in its parent folder", error);
  working_ = working;
}

void ResultsFolder::fill(const std::function<void()>& write) const {
  const auto rename = [&](std::string what) {
    const auto hidden = working_.string();
    if (const auto at = what.find(hidden); at != what.npos)
      what.replace(at, hidden.size(), path_.string());
    return what;
  };
  try {
    write();
  } catch (const base::BadInput& error) {
    throw base::BadInput(rename(error.what()));
  } catch (const std::system_error& error) {
    auto what = rename(error.what());
    if (what == error.what()) throw;
    if (const auto end = ": " + error.code().message(); what.ends_with(end))
      what.resize(what.size() - end.size());
    throw std::system_error(error.code(), what);
  }
}

ResultsFolder::~ResultsFolder() {
  const base::Undivided section;
  clean_up();
}

void ResultsFolder::clean_up() const {
  std::error_code ignored;
  if (is_committed_) return;
  if (!working_.empty()) remove_surely(working_);
  // has no effect on a parent folder that now contains other files
  for (const auto& parent : made_) fs::remove(parent, ignored);
}

void ResultsFolder::commit(const Check& check) {
  if (is_committed_) throw base::InvariantBroken(path_.string() + ": results committed twice");
  const base::Undivided section;
  check_replaced(path_, check);
  check_inputs_survive(path_, working_);
  replace(check);
  is_committed_ = true;
}

void ResultsFolder::replace(const Check& check) {
  for (;;) {
    if (rename_with(RENAME_EXCHANGE, working_, path_)) break;
    if (errno == ENOENT) {
      if (put_in_place(working_, path_)) return;
    } else if (is_unable(errno)) {
      return replace_in_two_steps(working_, path_, check);
    } else {
      fail(path_, "cannot move results into place", last_error());
    }
  }
  is_committed_ = true;  // the working folder now holds the older results and must not be removed
  try {
    check_replaced(working_, check);
  } catch (const std::exception& error) {
    if (!rename_with(RENAME_EXCHANGE, working_, path_))
      throw std::system_error(last_error(), fmt::format("{}; it cannot be put back to {}",
                                                        error.what(), path_.string()));
    is_committed_ = false;
    check_replaced(path_, check);  // throws an error that names `path_`
    throw;
  }
  drop_replaced(working_, path_);
}

}  // namespace laboratory

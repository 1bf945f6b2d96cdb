#pragma once
// The results folder of a run, which is replaced atomically.
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "base/early_end.hpp"

namespace laboratory {

/// Throws BadInput if writing results into `path` would destroy files of the user. This is so if
/// `path` is not a folder, if it is the current folder or one of its parents, or if it contains
/// files but neither run.json nor points/.
void check_results_folder(const std::filesystem::path& path);

/// Collects results in a hidden folder beside `path`, ".NAME.partial-HOST-PID". `commit` moves them
/// into place. Older results at `path` stay if `commit` is not called, or if the program ends early
/// (base/early_end.hpp). A process may have only one such object for each `path` at a time.
/// `commit` merges the records in points/ of both folders, and so keeps records that other
/// processes have written in the meantime.
class ResultsFolder {
 public:
  /// Makes missing parent folders. Removes hidden folders that dead processes left for the same
  /// `path`, after moving their point records to `path`. Throws as check_results_folder() does, and
  /// std::system_error if writing fails.
  explicit ResultsFolder(const std::filesystem::path& path);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// The folder to write into. Invalid after `commit`.
  const std::filesystem::path& working() const { return working_; }

  /// Calls `write`. If it throws an error of the host or BadInput, replaces the hidden folder by
  /// `path` in the message.
  void fill(const std::function<void()>& write) const;

  /// Called with the folder of older results. Throws if they must not be replaced.
  using Check = std::function<void(const std::filesystem::path& results)>;

  /// Replaces `path` as a whole, atomically if the file system supports it. May be called once.
  /// First repeats the constructor's check of `path` and calls `check`; if either throws, the older
  /// results stay in place. Checks the older results again after moving them aside, since another
  /// process may have written them in the meantime.
  void commit(const Check& check = {});

 private:
  void make_working();
  void clean_up() const;
  void replace(const Check& check);

  std::filesystem::path path_, working_;
  std::vector<std::filesystem::path> made_;  // parent folders made by this object, innermost first
  bool is_committed_ = false;
  std::optional<base::Undo> undo_;
};

}  // namespace laboratory

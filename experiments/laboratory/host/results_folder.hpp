#pragma once
// Atomically replaced results folder.
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "base/early_end.hpp"

namespace laboratory {

/// Throws BadInput if writing results would destroy foreign files. This is so if `path` is not a
/// folder, is the current folder or a parent of it, or holds files but neither run.json nor
/// points/.
void check_results_folder(const std::filesystem::path& path);

/// Collects results in a hidden folder beside `path`, ".NAME.partial-HOST-PID"; `commit` moves them
/// into place. An older `path` stays if there is no commit, or if the program ends early
/// (base/early_end.hpp). A process may have only one object for each `path` at a time. Records in
/// points/ of both folders are merged, so that records which other processes write meanwhile are
/// kept.
class ResultsFolder {
 public:
  /// Makes missing parents. Removes remains of dead processes for the same `path`, after moving
  /// their point records to `path`. Throws as check_results_folder does, and std::system_error if
  /// writing fails.
  explicit ResultsFolder(const std::filesystem::path& path);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// The folder to write into. Invalid after `commit`.
  const std::filesystem::path& working() const { return working_; }

  /// Calls `write`. Errors of the host and of input then name `path` instead of the hidden folder.
  void fill(const std::function<void()>& write) const;

  /// Throws if these results must not be replaced.
  using Check = std::function<void(const std::filesystem::path& results)>;

  /// Replaces `path` as a whole, atomically if the file system can. Called once. First repeats the
  /// constructor's check of `path` and calls `check`. If either throws, the older results stay in
  /// place. Older results are checked again after they have been moved aside, since another process
  /// may have written them in between.
  void commit(const Check& check = {});

 private:
  void make_working();
  void clean_up() const;
  void replace(const Check& check);

  std::filesystem::path path_, working_;
  std::vector<std::filesystem::path> made_;  // parents made by this object, innermost first
  bool is_committed_ = false;
  std::optional<base::Undo> undo_;
};

}  // namespace laboratory

#pragma once
// A results folder that is replaced atomically.
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "base/early_end.hpp"

namespace laboratory {

/// Throws BadInput if results would destroy foreign files: `path` is not a folder, is the current
/// folder or a parent of it, or holds files without run.json or points/.
void check_results_folder(const std::filesystem::path& path);

/// Collects results in a hidden folder beside `path` (".NAME.partial-HOST-PID"); `commit` puts them
/// in place. Without a commit, or if the program ends early (base/early_end.hpp), an older `path`
/// remains. Allows one object at a time for each process and `path`. Folders in points/ of both are
/// merged, so that no record is lost that another process writes meanwhile.
class ResultsFolder {
 public:
  /// Makes missing parents, and removes remains of dead processes for the same `path`, except for
  /// point records, which move to `path`. Throws as check_results_folder does, and
  /// std::system_error if writing fails.
  explicit ResultsFolder(const std::filesystem::path& path);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// The folder to write into; invalid after `commit`.
  const std::filesystem::path& working() const { return working_; }

  /// Calls `write`; errors of the host and of input then name `path` in place of the folder.
  void fill(const std::function<void()>& write) const;

  /// Throws if the results must not be replaced.
  using Check = std::function<void(const std::filesystem::path& results)>;

  /// Replaces `path` as a whole, in one step if the file system can; called once. First repeats the
  /// constructor's check of `path`, then calls `check`, and throws as they do, with older results
  /// still there. Checks older results again after moving them aside: another process may have put
  /// them there in between.
  void commit(const Check& check = {});

 private:
  void make_working();
  void clean_up() const;
  void replace(const Check& check);

  std::filesystem::path path_, working_;
  std::vector<std::filesystem::path> made_;  // parents that were missing, innermost first
  bool is_committed_ = false;
  std::optional<base::Undo> undo_;
};

}  // namespace laboratory

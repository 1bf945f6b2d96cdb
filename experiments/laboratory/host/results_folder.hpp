#pragma once
// A folder of results that appears at once.
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "base/early_end.hpp"

namespace laboratory {

/// Throws BadInput where results would destroy something that is not ours: `path` is no folder,
/// holds files but neither run.json nor points/, or holds the current folder.
void check_results_folder(const std::filesystem::path& path);

/// Collects results in a hidden folder beside `path` (".NAME.partial-HOST-PID"); `commit` puts them
/// in its place. Until then, or without it, also when the program ends early (base/early_end.hpp),
/// an older `path` stays as it was. There is one at a time
/// for each process and `path`. Folders in points/ that both have get the records of the older one:
/// no record is lost that another process writes meanwhile.
class ResultsFolder {
 public:
  /// Makes missing parents, and removes what dead processes left for the same `path`, except for
  /// records of points, which go to `path`. Throws as check_results_folder does, and
  /// std::system_error where nothing can be written.
  explicit ResultsFolder(const std::filesystem::path& path);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// The folder to write into; it is gone after `commit`.
  const std::filesystem::path& working() const { return working_; }

  /// Calls what writes there; errors of the host and of input name `path` in place of the folder.
  void fill(const std::function<void()>& write) const;

  /// Throws where results must not be replaced.
  using Check = std::function<void(const std::filesystem::path& results)>;

  /// Replaces `path` as a whole, in one step where the file system can; called once. Checks `path`
  /// again as the constructor did some time ago, and with `check`, and throws as these do; then the
  /// older results are still there. They are checked once more when they are out of the way:
  /// another process may have put them there in between.
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

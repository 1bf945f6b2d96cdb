// Files that are whole or absent, and a folder of results that appears at once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace laboratory {

/// What takes the parts of a file, in order.
using Sink = std::function<void(std::string_view)>;

/// Writes beside `path` (".NAME.partial-PID-N"), then renames. When a step fails (a full disk, a
/// missing folder) nothing is left behind and an older file keeps its bytes; throws
/// std::system_error with the path. A link is followed; what exists and is not a regular file
/// (/dev/stdout, a pipe) is written to directly.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The same of a file whose parts `produce` hands over one by one.
void write_file(const std::filesystem::path& path, const std::function<void(const Sink&)>& produce);

/// std::system_error with the path.
std::string read_file(const std::filesystem::path& path);

/// Throws std::invalid_argument where results would destroy something that is not ours: `path` is
/// no folder, holds files but neither run.json nor points/, or holds the current folder.
void check_results_folder(const std::filesystem::path& path);

/// Collects results in a hidden folder beside `path` (".NAME.partial-HOST-PID"); `commit` puts them
/// in its place. Until then, or without it, an older `path` stays as it was. One at a time per
/// process and `path`. Of the folders in points/ that both have, those of the older one are added
/// to: no record is lost that another process writes meanwhile.
class ResultsFolder {
 public:
  /// Makes missing parents, and brings what dead processes left for the same `path` to an end: it
  /// is removed, but for records of points, which go to `path`. Throws as check_results_folder;
  /// std::system_error where nothing can be written.
  explicit ResultsFolder(const std::filesystem::path& path);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// Where to write; gone after `commit`.
  const std::filesystem::path& working() const { return working_; }

  /// Replaces `path` as a whole, in one step where the file system can. Throws as the constructor,
  /// which looked some time ago; then the older results are still there. Once only.
  void commit();

 private:
  std::filesystem::path path_, working_;
  std::vector<std::filesystem::path> made_;  // parents that were missing, innermost first
  bool is_committed_ = false;
};

}  // namespace laboratory

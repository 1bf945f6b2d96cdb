#pragma once
// Private temporary folder. The destructor removes the folder. If a signal ends the program, the
// folder is removed too.
#include <filesystem>
#include <optional>

#include "base/early_end.hpp"

namespace laboratory {

class TemporaryFolder {
 public:
  /// Throws std::system_error if the folder cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<base::Undo> undo_;
};

}  // namespace laboratory

#include "experiments/laboratory/host/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace laboratory {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  const base::Undivided section;
  std::string name = (fs::temp_directory_path() / "tlab-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
  undo_.emplace([folder = path_] {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  });
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace laboratory

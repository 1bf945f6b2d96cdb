#include "experiments/laboratory/host/link_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/early_end.hpp"
#include "base/whole_file.hpp"

namespace laboratory {

namespace fs = std::filesystem;

namespace {

// Makes `to` a hard link to `from`. Returns false if the file system does not support hard links.
bool link_file(const fs::path& from, const fs::path& to) {
  if (link(from.c_str(), to.c_str()) == 0 || errno == EEXIST) return true;
  for (const int unable : {EPERM, EXDEV, EMLINK, ENOSYS, EOPNOTSUPP})
    if (errno == unable) return false;
  if (errno == ENOENT && !fs::exists(from)) return true;  // another process has removed `from`
  throw std::system_error(errno, std::generic_category(), to.string() + ": cannot be written");
}

void link_or_copy(const fs::path& from, const fs::path& to) {
  const base::Undivided section;
  if (!link_file(from, to)) base::save_whole(to, base::read_text(from));
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

}  // namespace

void make_folders(const fs::path& path) {
  const base::Undivided section;
  fs::create_directories(path);
}

void link_file(const fs::path& from, const fs::path& to) {
  const base::Undivided section;
  std::error_code ignored;
  fs::remove(to, ignored);
  link_or_copy(from, to);
}

void link_files(const fs::path& from, const fs::path& to) {
  if (!fs::is_directory(from)) return;
  make_folders(to);
  for (const auto& entry : fs::directory_iterator(from)) {
    const auto target = to / entry.path().filename();
    if (!entry.is_regular_file() || is_hidden(entry.path()) || fs::exists(target)) continue;
    link_or_copy(entry.path(), target);
  }
}

void link_records(const fs::path& from, const fs::path& to) {
  if (!fs::is_directory(from / "points")) return;
  for (const auto& entry : fs::directory_iterator(from / "points"))
    if (entry.is_directory() && entry.path().filename() != "lone")
      link_files(entry.path(), to / "points" / entry.path().filename());
}

}  // namespace laboratory

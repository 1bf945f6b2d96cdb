#include "experiments/laboratory/host/carry.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "experiments/laboratory/host/files.hpp"

namespace laboratory {

namespace fs = std::filesystem;

namespace {

// Whether `to` is there now.
bool link_file(const fs::path& from, const fs::path& to) {
  if (link(from.c_str(), to.c_str()) == 0 || errno == EEXIST) return true;
  for (const int unable : {EPERM, EXDEV, EMLINK, ENOSYS, EOPNOTSUPP})
    if (errno == unable) return false;
  if (errno == ENOENT && !fs::exists(from)) return true;  // somebody has removed it meanwhile
  throw std::system_error(errno, std::generic_category(),
                          fmt::format("{}: cannot write", to.string()));
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

}  // namespace

void carry_file(const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  fs::remove(to, ignored);
  if (!link_file(from, to)) write_file(to, read_file(from));
}

void carry_files(const fs::path& from, const fs::path& to) {
  if (!fs::is_directory(from)) return;
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(from)) {
    const auto target = to / entry.path().filename();
    if (!entry.is_regular_file() || is_hidden(entry.path()) || fs::exists(target)) continue;
    if (!link_file(entry.path(), target)) write_file(target, read_file(entry.path()));
  }
}

void carry_records(const fs::path& from, const fs::path& to) {
  if (!fs::is_directory(from / "points")) return;
  for (const auto& entry : fs::directory_iterator(from / "points"))
    if (entry.is_directory() && entry.path().filename() != "lone")
      carry_files(entry.path(), to / "points" / entry.path().filename());
}

}  // namespace laboratory

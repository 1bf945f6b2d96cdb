#include "base/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "base/errors.hpp"

namespace base {

namespace {

namespace fs = std::filesystem;

using Write = std::function<void(std::ostream&)>;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          path.string() + ": cannot be written");
}

// A name beside `path` that no other file has.
fs::path partial_of(const fs::path& path) {
  static std::atomic<int> count = 0;
  return path.parent_path() /
         fmt::format(".{}.partial-{}-{}", path.filename().string(), getpid(), ++count);
}

// Errors name `path`.
void write_file(const fs::path& file, const fs::path& path, const Write& write) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  if (out) write(out);
  out.close();
  if (!out) fail(path, errno);
}

// Some file systems find out here that there was no room; some have nothing to do.
void sync_file(const fs::path& file, const fs::path& path) {
  const int number = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = number < 0 || fsync(number) != 0 ? errno : 0;
  if (number >= 0) close(number);
  if (error != 0 && error != EINVAL && error != ENOTSUP) fail(path, error);
}

void write_and_rename(const fs::path& path, const Write& write) {
  const auto partial = partial_of(path);
  try {
    write_file(partial, path, write);
    sync_file(partial, path);
    if (std::rename(partial.c_str(), path.c_str()) != 0) fail(path, errno);
  } catch (...) {
    unlink(partial.c_str());
    throw;
  }
}

}  // namespace

void save_whole(const fs::path& path, const Write& write) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_file(path, path, write);
  write_and_rename(fs::exists(status) ? fs::canonical(path) : path, write);
}

void save_whole(const fs::path& path, std::string_view bytes) {
  save_whole(path, [&](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

void check_can_save(const fs::path& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  const auto partial = partial_of(fs::exists(status) ? fs::canonical(path) : path);
  write_file(partial, path, [](std::ostream&) {});
  unlink(partial.c_str());
}

std::string read_text(const fs::path& path, std::size_t most) {
  const int earlier = std::exchange(errno, 0);  // whoever writes a file meanwhile may need it
  std::ifstream in(path, std::ios::binary);
  std::string text, part(1 << 16, '\0');
  while (in && text.size() <= most) {
    in.read(part.data(), static_cast<std::streamsize>(part.size()));
    text.append(part, 0, static_cast<std::size_t>(in.gcount()));
  }
  require(in || in.eof(), path.string(), "cannot be read: {}",
          std::generic_category().message(errno));
  require(text.size() <= most, path.string(), "longer than the limit of {} bytes", most);
  errno = earlier;
  return text;
}

}  // namespace base

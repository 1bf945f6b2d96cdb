#include "experiments/laboratory/host/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace laboratory {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw std::system_error(error, std::generic_category(),
                          fmt::format("{}: {}", path.string(), what));
}

// An open file; `path` is what errors name.
class File {
 public:
  File(const fs::path& opened, const fs::path& path, int flags, const char* what)
      : path_(path), number_(open(opened.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) fail(path, what, errno);
  }
  ~File() {
    if (number_ >= 0) ::close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(number_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path_, "cannot write", errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  std::string read() {
    std::string bytes;
    char part[1 << 16];
    while (true) {
      const ssize_t found = ::read(number_, part, sizeof part);
      if (found < 0 && errno == EINTR) continue;
      if (found < 0) fail(path_, "cannot read", errno);
      if (found == 0) return bytes;
      bytes.append(part, static_cast<std::size_t>(found));
    }
  }

  // Some file systems find out here that there was no room; some have nothing to do.
  void sync() {
    if (fsync(number_) != 0 && errno != EINVAL && errno != ENOTSUP)
      fail(path_, "cannot write", errno);
  }

  void close() {
    const int number = number_;
    number_ = -1;
    if (::close(number) != 0 && errno != EINTR) fail(path_, "cannot write", errno);
  }

 private:
  const fs::path& path_;
  int number_;
};

using Produce = std::function<void(const Sink&)>;

void write_and_rename(const fs::path& path, const Produce& produce) {
  static std::atomic<int> count = 0;
  const auto partial =
      path.parent_path() /
      fmt::format(".{}.partial-{}-{}", path.filename().string(), getpid(), ++count);
  File file(partial, path, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, "cannot create");
  try {
    produce([&](std::string_view bytes) { file.write(bytes); });
    file.sync();
    file.close();
    if (std::rename(partial.c_str(), path.c_str()) != 0) fail(path, "cannot replace", errno);
  } catch (...) {
    unlink(partial.c_str());
    throw;
  }
}

}  // namespace

void write_file(const fs::path& path, const Produce& produce) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    File file(path, path, O_WRONLY, "cannot open");
    produce([&](std::string_view bytes) { file.write(bytes); });
    return file.close();
  }
  const bool is_link = fs::exists(status) && fs::is_symlink(fs::symlink_status(path, error));
  write_and_rename(is_link ? fs::canonical(path) : path, produce);
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file(path, [&](const Sink& sink) { sink(bytes); });
}

std::string read_file(const fs::path& path) {
  return File(path, path, O_RDONLY, "cannot open").read();
}

}  // namespace laboratory

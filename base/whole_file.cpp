#include "base/whole_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/errors.hpp"

namespace base {

namespace {

namespace fs = std::filesystem;

using Write = std::function<int(std::FILE*)>;

[[noreturn]] void fail(const std::string& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          fmt::format("cannot write {}", path));
}

// Opens, writes and closes; 0 or the error.
int write_file(const std::string& path, const Write& write) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  errno = 0;
  int error = write(file);
  if (error == 0 && std::fflush(file) != 0) error = errno != 0 ? errno : EIO;
  return std::fclose(file) == 0 || error != 0 ? error : errno;
}

}  // namespace

void save_whole(const std::string& path, const Write& write) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  // A device or a pipe cannot be replaced: it is written in place.
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (const int error = write_file(path, write)) fail(path, error);
    return;
  }
  // What a link points to is replaced, not the link.
  const std::string target = fs::exists(status) ? fs::canonical(path).string() : path;
  const std::string draft = fmt::format("{}.{}.part", target, ::getpid());
  int error = write_file(draft, write);
  if (error == 0 && std::rename(draft.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(draft.c_str());
    fail(path, error);
  }
}

namespace {

[[noreturn]] void fail_reading(const std::string& file, const std::string& what) {
  throw BadInput(fmt::format("{}: {}", file, what));
}

}  // namespace

std::string read_text(const std::string& path, std::size_t most) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail_reading(path, "no such file");
  if (std::filesystem::is_directory(status)) fail_reading(path, "is a directory, expected a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail_reading(path, fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string text(most + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) fail_reading(path, "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > most)
    fail_reading(path, fmt::format("longer than the limit of {} bytes", most));
  return text;
}

}  // namespace base

#include "base/output_pipe.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include "base/errors.hpp"

namespace base {

namespace {

using PipeId = std::pair<dev_t, ino_t>;

std::mutex pipes_mutex;
std::map<PipeId, int> open_pipes;  // descriptors of pipes that nothing was written to yet

[[noreturn]] void fail_on_pipe(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string() + ": cannot be written");
}

PipeId identify_pipe(const std::filesystem::path& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) fail_on_pipe(path);
  return {found.st_dev, found.st_ino};
}

// Returns the descriptor of the pipe, which blocks in write() as usual.
int open_to_write(const std::filesystem::path& path) {
  constexpr int TRIALS = 100;
  constexpr timespec PAUSE{0, 10'000'000};
  int file = -1;
  for (int i = 0; i < TRIALS && file < 0; ++i) {
    if (i > 0) nanosleep(&PAUSE, nullptr);
    file = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file < 0 && errno != ENXIO && errno != EINTR) fail_on_pipe(path);
  }
  require(file >= 0, path.string(),
          "cannot be written: found a pipe that nobody reads, expected a file, or a pipe with a "
          "reader");
  fcntl(file, F_SETFL, O_WRONLY);
  return file;
}

// Takes over the descriptor of an open pipe, or opens the pipe.
int take_pipe(const std::filesystem::path& path) {
  const std::lock_guard lock(pipes_mutex);
  const auto found = open_pipes.extract(identify_pipe(path));
  return found ? found.mapped() : open_to_write(path);
}

}  // namespace

void open_output_pipe(const std::filesystem::path& path) {
  const std::lock_guard lock(pipes_mutex);
  const auto id = identify_pipe(path);
  if (!open_pipes.contains(id)) open_pipes[id] = open_to_write(path);
}

void write_to_pipe(const std::filesystem::path& path, std::string_view bytes) {
  const int file = take_pipe(path);
  while (!bytes.empty()) {
    const auto written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      close(file);
      errno = error;
      fail_on_pipe(path);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  close(file);
}

}  // namespace base

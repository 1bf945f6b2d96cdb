#include "base/whole_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "base/partial_name.hpp"

namespace base {

namespace {

namespace fs = std::filesystem;

// Limits on the number of bytes read from a pipe and from any other file.
constexpr std::size_t MOST_FROM_PIPE = std::size_t{1} << 28, MOST_FROM_FILE = std::size_t{1} << 30;

// Identifies the content of a file: device, inode, and seconds and nanoseconds of the last
// modification.
using Identity = std::tuple<dev_t, ino_t, time_t, long>;

std::mutex inputs_mutex;
std::optional<std::set<Identity>> inputs;  // files read so far; none if no InputGuard exists

Identity identify(const struct stat& file) {
  return {file.st_dev, file.st_ino, file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

using Write = std::function<void(std::ostream&)>;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          find_final_path(path).string() + ": cannot be written");
}

using PipeId = std::pair<dev_t, ino_t>;

std::mutex pipes_mutex;
std::map<PipeId, int> open_pipes;  // descriptors of pipes that nothing was written to yet

PipeId identify_pipe(const fs::path& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) fail(path, errno);
  return {found.st_dev, found.st_ino};
}

// Returns the descriptor of the pipe, which blocks in write() as usual.
int open_to_write(const fs::path& path) {
  constexpr int TRIALS = 100;
  constexpr timespec PAUSE{0, 10'000'000};
  int file = -1;
  for (int i = 0; i < TRIALS && file < 0; ++i) {
    if (i > 0) nanosleep(&PAUSE, nullptr);
    file = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file < 0 && errno != ENXIO && errno != EINTR) fail(path, errno);
  }
  require(file >= 0, path.string(),
          "cannot be written: found a pipe that nobody reads, expected a file, or a pipe with a "
          "reader");
  fcntl(file, F_SETFL, O_WRONLY);
  return file;
}

// Takes over the descriptor of an open pipe, or opens the pipe.
int take_pipe(const fs::path& path) {
  const std::lock_guard lock(pipes_mutex);
  const auto found = open_pipes.extract(identify_pipe(path));
  return found ? found.mapped() : open_to_write(path);
}

// Opens the pipe for writing and keeps it open until write_to_pipe() has written to it, since a
// reader stops when the last writer closes the pipe. Waits at most one second for a reader. Throws
// BadInput "path: cannot be written: found a pipe that nobody reads" if none appears, and
// std::system_error for other errors.
void open_output_pipe(const fs::path& path) {
  const std::lock_guard lock(pipes_mutex);
  const auto id = identify_pipe(path);
  if (!open_pipes.contains(id)) open_pipes[id] = open_to_write(path);
}

// Writes the bytes to the pipe and closes it; opens it first unless it is open. Throws the errors
// of open_output_pipe(), and std::system_error if the reader goes away.
void write_to_pipe(const fs::path& path, std::string_view bytes) {
  const int file = take_pipe(path);
  while (!bytes.empty()) {
    const auto written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      close(file);
      fail(path, error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  close(file);
}

// A unique hidden name beside `path`. It is short enough for the file system if the name in `path`
// is.
fs::path partial_of(const fs::path& path) {
  static std::atomic<int> count = 0;
  constexpr std::size_t LONGEST = 100;
  const auto known = path.filename().string().substr(0, LONGEST);
  const auto name = make_partial_name(known, "partial", getpid());
  return path.parent_path() / fmt::format("{}-{}", name, ++count);
}

// Writes the content to the stream and closes it. Error messages name `path`.
void fill_file(std::ofstream& out, const fs::path& path, const Write& write) {
  if (out) write(out);
  out.close();
  if (!out) fail(path, errno);
}

void write_in_place(const fs::path& path, const Write& write) {
  if (fs::is_fifo(path)) {
    std::ostringstream text;
    write(text);
    return write_to_pipe(path, text.view());
  }
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  fill_file(out, path, write);
}

// True if the error code means that the file system does not support the operation.
bool is_unable(int error) {
  return error == ENOSYS || error == EINVAL || error == ENOTSUP || error == EPERM;
}

// Creates an empty file. Returns false and sets errno if the file exists or cannot be created.
bool make_empty(const fs::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  return file >= 0 && close(file) == 0;
}

// A new file beside `path`. The destructor deletes it unless it has been renamed.
class PartialFile {
 public:
  explicit PartialFile(const fs::path& path)
      : path_(path), partial_(partial_of(path)), undo_([this] { unlink(partial_.c_str()); }) {
    const Undivided section;
    errno = 0;
    out_.open(partial_, std::ios::binary);
  }
  ~PartialFile() {
    const Undivided section;
    if (!is_renamed_) unlink(partial_.c_str());
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  const fs::path& path() const { return partial_; }
  void fill(const Write& write) { fill_file(out_, path_, write); }
  // Renames the file to `path`. Returns false if `path` exists.
  bool rename_to_new() {
    const Undivided section;
    if (renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) == 0)
      return is_renamed_ = true;
    // If renameat2 is not supported, give the file its final name by a hard link. The destructor
    // removes the temporary name.
    if (is_unable(errno) && link(partial_.c_str(), path_.c_str()) == 0) return true;
    // If hard links are not supported, reserve the final name with an empty file, then rename the
    // new file over it.
    if (is_unable(errno) && make_empty(path_)) {
      rename();
      return true;
    }
    if (errno != EEXIST) fail(path_, errno);
    return false;
  }
  void rename() {
    const Undivided section;
    if (std::rename(partial_.c_str(), path_.c_str()) != 0) fail(path_, errno);
    is_renamed_ = true;
  }

 private:
  const fs::path path_, partial_;
  std::ofstream out_;
  bool is_renamed_ = false;
  const Undo undo_;
};

// Flushes the file to disk, because some file systems report a full disk only then. Ignores the
// error if the file system cannot flush.
void sync_file(const fs::path& file, const fs::path& path) {
  const int number = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = number < 0 || fsync(number) != 0 ? errno : 0;
  if (number >= 0) close(number);
  if (error != 0 && error != EINVAL && error != ENOTSUP) fail(path, error);
}

void write_and_rename(const fs::path& path, const Write& write) {
  PartialFile partial(path);
  partial.fill(write);
  sync_file(partial.path(), path);
  partial.rename();
}

// A file or pipe, opened for reading.
class Input {
 public:
  // Remembers the file as an input if `is_kept`. Throws BadInput for folders and devices.
  Input(const fs::path& path, bool is_kept)
      : path_(path), file_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (file_ < 0) fail_to_read();
    struct stat found {};
    fstat(file_, &found);
    is_pipe_ = S_ISFIFO(found.st_mode);
    size_ = found.st_size > 0 ? static_cast<std::size_t>(found.st_size) : 0;
    if (S_ISREG(found.st_mode) && is_kept) note_input(found);
    if (is_pipe_ || S_ISREG(found.st_mode)) return;
    close(file_);
    errno = EISDIR;
    if (S_ISDIR(found.st_mode)) fail_to_read();
    refuse(path_.string(), "cannot be read: found a device, expected a file or a pipe");
  }
  ~Input() { close(file_); }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  bool is_pipe() const { return is_pipe_; }

  std::string read(std::size_t most) const {
    if (is_pipe_) most = std::min(most, MOST_FROM_PIPE);
    const auto check_size = [&](std::size_t size) {
      require(size <= most, path_.string(), "longer than the limit of {} bytes", most);
    };
    check_size(size_);  // refuses a sparse file before reading it
    // The system states the size 0 for files in /proc, so files may be longer than their stated
    // size.
    most = std::min(most, std::max(size_, MOST_FROM_FILE));
    std::string text, part(1 << 16, '\0');
    while (text.size() <= most) {
      const auto size = ::read(file_, part.data(), part.size());
      if (size > 0)
        text.append(part, 0, static_cast<std::size_t>(size));
      else if (size == 0 && !is_pipe_)
        break;
      else if (!waits_for_more(size, text.empty()))
        break;
    }
    check_size(text.size());
    return text;
  }

 private:
  [[noreturn]] void fail_to_read() const {
    refuse(path_.string(), "cannot be read: {}", std::generic_category().message(errno));
  }
  // Waits until the pipe has more bytes. Returns false at the end of the file or pipe.
  bool waits_for_more(ssize_t size, bool is_empty) const {
    constexpr int FOR_A_WRITER_MS = 1000;
    pollfd readable{file_, POLLIN, 0};
    if (size == 0 && !is_empty) return false;
    if (size < 0 && errno != EAGAIN && errno != EINTR) fail_to_read();
    const int found = poll(&readable, 1, size < 0 ? -1 : FOR_A_WRITER_MS);
    require(size < 0 || (found > 0 && (readable.revents & POLLIN)), path_.string(),
            "cannot be read: found an empty pipe, expected a file, or a pipe with a writer");
    return true;
  }

  const fs::path path_;
  const int file_;
  bool is_pipe_ = false;
  std::size_t size_ = 0;  // size of a regular file when it was opened, in bytes
};

// The host's memory in bytes. A larger file cannot be read.
std::size_t measure_memory() {
  const auto pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(size)
                               : SIZE_MAX;
}

Write write_bytes(std::string_view bytes) {
  return [bytes](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
}

}  // namespace

InputGuard::InputGuard() {
  const std::lock_guard lock(inputs_mutex);
  inputs.emplace();
}

InputGuard::~InputGuard() {
  const std::lock_guard lock(inputs_mutex);
  inputs.reset();
}

void note_input(const struct stat& file) {
  const std::lock_guard lock(inputs_mutex);
  if (inputs) inputs->insert(identify(file));
}

void check_no_input(const std::filesystem::path& path) {
  struct stat file {};
  if (stat(path.c_str(), &file) != 0) return;
  const std::lock_guard lock(inputs_mutex);
  require(!inputs || !inputs->contains(identify(file)), path.string(),
          "cannot be written: the command reads this file, expected another name");
}

void save_whole(const fs::path& path, const Write& write) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_in_place(path, write);
  check_no_input(path);
  write_and_rename(fs::exists(status) ? fs::canonical(path) : path, write);
}

void save_whole(const fs::path& path, std::string_view bytes) {
  save_whole(path, write_bytes(bytes));
}

bool save_new(const fs::path& path, std::string_view bytes) {
  PartialFile partial(path);
  partial.fill(write_bytes(bytes));
  sync_file(partial.path(), path);
  return partial.rename_to_new();
}

void check_can_save(const fs::path& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail(path, EISDIR);
  check_no_input(path);
  if (fs::is_fifo(status)) return open_output_pipe(path);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  PartialFile(fs::exists(status) ? fs::canonical(path) : path).fill([](std::ostream&) {});
}

std::string read_text(const fs::path& path, std::size_t most) {
  return Input(path, /*is_kept=*/true).read(std::min(most, MOST_FROM_FILE));
}

std::string read_own_text(const fs::path& path, std::size_t most) {
  return Input(path, /*is_kept=*/false).read(std::min(most, measure_memory()));
}

void check_can_read(const fs::path& path) {
  const Input input(path, /*is_kept=*/true);
  require(!input.is_pipe(), path.string(), "cannot be read: found a pipe, expected a file");
}

}  // namespace base

#include "base/host_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "base/early_end.hpp"
#include "base/text.hpp"

namespace base {

namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// An unnamed file in memory. Unlike a pipe, it cannot block the program that reads or writes it.
class Scratch {
 public:
  explicit Scratch(std::string_view text = {}) : file_(memfd_create("tlab", MFD_CLOEXEC)) {
    if (file_ < 0) fail("a temporary file");
    while (!text.empty()) {
      const auto written = write(file_, text.data(), text.size());
      if (written <= 0) {
        close(file_);
        fail("a temporary file");
      }
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(file_, 0, SEEK_SET);
  }
  ~Scratch() { close(file_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  int number() const { return file_; }

  std::string text() const {
    lseek(file_, 0, SEEK_SET);
    std::string text;
    char part[1 << 16];
    for (ssize_t found; (found = read(file_, part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(found));
    return text;
  }

 private:
  int file_;
};

// The path of a program that is in a folder of the variable PATH; none if it is in no such folder.
std::optional<std::string> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (const auto folder : split(path ? path : "/usr/local/bin:/usr/bin:/bin", ':')) {
    auto file = fmt::format("{}/{}", folder.empty() ? "." : folder, name);
    struct stat found {};
    if (stat(file.c_str(), &found) == 0 && S_ISREG(found.st_mode) &&
        access(file.c_str(), X_OK) == 0)
      return file;
  }
  return {};
}

// A small environment in which the output of programs depends neither on the user's language nor on
// the user's settings of gnuplot (GNUTERM), Graphviz (GVBINDIR) or fontconfig (FONTCONFIG_FILE).
std::vector<std::string> neutral_environment() {
  std::vector<std::string> kept = {"LC_ALL=C.UTF-8", "FC_LANG=en"};
  for (const char* name : {"PATH", "HOME", "TMPDIR", "LD_LIBRARY_PATH"})
    if (const char* value = std::getenv(name)) kept.push_back(fmt::format("{}={}", name, value));
  return kept;
}

std::vector<char*> to_pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (auto& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// The data that the new process needs, prepared in advance: a process must not allocate memory
// between fork and exec.
struct Start {
  const char* path;
  char* const* arguments;
  char* const* environment;
  int streams[3];
};

// Starts the program in the new process. The kernel kills the process when the thread that started
// it ends.
[[noreturn]] void execute(const Start& start, pid_t parent) {
  constexpr int CANNOT_START = 127;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  for (const int ours : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) signal(ours, SIG_DFL);
  for (int i = 0; i < 3; ++i)
    if (start.streams[i] != i) dup2(start.streams[i], i);
  execve(start.path, start.arguments, start.environment);
  _exit(CANNOT_START);
}

// A child process. The destructor and an early end of tlab kill it.
class Child {
 public:
  explicit Child(const Start& start) {
    const Undivided section;
    const pid_t parent = getpid();
    id_ = fork();
    if (id_ < 0) fail("another process");
    if (id_ == 0) execute(start, parent);
    undo_.emplace([this] { kill(id_, SIGKILL); });
  }
  ~Child() {
    if (!undo_) return;
    kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Returns the exit code, or the number of the signal that ended the process.
  int wait() {
    siginfo_t end{};
    while (waitid(P_PID, static_cast<id_t>(id_), &end, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    }
    undo_.reset();  // after waitpid(), the system may reuse the id
    waitpid(id_, nullptr, 0);
    return end.si_status;
  }

 private:
  pid_t id_ = -1;
  std::optional<Undo> undo_;
};

}  // namespace

void ignore_font_settings() {
  std::vector<std::string> names = {"FREETYPE_PROPERTIES"};
  for (char** at = environ; at && *at; ++at) {
    const std::string_view variable = *at;
    if (variable.starts_with("FONTCONFIG_") || variable.starts_with("FC_"))
      names.emplace_back(variable.substr(0, variable.find('=')));
  }
  for (const auto& name : names) unsetenv(name.c_str());
  setenv("FC_LANG", "en", 1);  // otherwise fontconfig takes the language from LANG and LC_*
}

std::string run_program(const HostProgram& program) {
  const auto path = find_program(program.name);
  if (!path)
    throw std::runtime_error(
        fmt::format("{}: drawing needs the program {}, which was not found: {}", program.purpose,
                    program.name, program.remedy));
  std::vector<std::string> arguments{program.name}, environment = neutral_environment();
  arguments.insert(arguments.end(), program.arguments.begin(), program.arguments.end());
  const auto argument_list = to_pointers(arguments), variables = to_pointers(environment);
  const Scratch input(program.input), output, errors;
  Child child({.path = path->c_str(),
               .arguments = argument_list.data(),
               .environment = program.shows_output ? environ : variables.data(),
               .streams = {input.number(), program.shows_output ? STDOUT_FILENO : output.number(),
                           errors.number()}});
  if (const int exit_code = child.wait(); exit_code != 0)
    throw std::runtime_error(fmt::format("{}: {} failed (exit code {}): {}", program.purpose,
                                         program.name, exit_code, trim(errors.text())));
  return output.text();
}

}  // namespace base

#include "base/host_program.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "base/early_end.hpp"
#include "base/text.hpp"

namespace base {

namespace {

namespace process = boost::process;

// An unnamed temporary file, deleted by the destructor. Unlike a pipe, it cannot block the program
// that reads or writes it.
class Scratch {
 public:
  Scratch() : file_(std::tmpfile(), &std::fclose) { check(file_ != nullptr); }
  explicit Scratch(const std::string& text) : Scratch() {
    check(std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size());
    check(std::fflush(file_.get()) == 0);
    std::rewind(file_.get());
  }

  std::FILE* get() const { return file_.get(); }

  std::string read() const {
    std::rewind(file_.get());
    std::string text;
    char part[1 << 16];
    while (const auto found = std::fread(part, 1, sizeof part, file_.get()))
      text.append(part, found);
    return text;
  }

 private:
  static void check(bool holds) {
    if (!holds) throw std::system_error(errno, std::generic_category(), "a temporary file");
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

// Runs in the new process. Has the kernel kill the process when the thread that started it ends,
// and restores the default signal handlers.
void set_up_child(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  for (const int ours : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) signal(ours, SIG_DFL);
}

// Serialises program starts. During a start, Boost reads a pipe until the new program closes it. A
// program started meanwhile by another thread would inherit the pipe, and Boost would wait until
// that program ends, too.
std::mutex starts;

// A child process, terminated by the destructor or by an early end of tlab.
class Child {
 public:
  template <class... Settings>
  explicit Child(Settings&&... settings) {
    const Undivided section;
    const std::lock_guard lock(starts);
    child_ = process::child(
        std::forward<Settings>(settings)...,
        process::extend::on_exec_setup([parent = getpid()](const auto&) { set_up_child(parent); }));
    undo_.emplace([this] { kill(child_.id(), SIGKILL); });
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Returns the exit code, or the number of the signal that ended the process.
  int wait() {
    child_.wait();
    undo_.reset();  // the system may reuse the process id from now on
    return child_.exit_code();
  }

 private:
  std::optional<Undo> undo_;
  process::child child_;  // its destructor terminates a running process
};

}  // namespace

std::string run_program(const HostProgram& program) {
  const auto path = process::search_path(program.name);
  if (path.empty())
    throw std::runtime_error(
        fmt::format("{}: drawing needs the program {}, which was not found: {}", program.purpose,
                    program.name, program.remedy));
  const Scratch input(program.input), output, errors;
  Child child(process::exe = path, process::args = program.arguments,
              (process::std_in < input.get()),
              (process::std_out > (program.shows_output ? stdout : output.get())),
              (process::std_err > errors.get()));
  if (const int exit_code = child.wait(); exit_code != 0)
    throw std::runtime_error(fmt::format("{}: {} failed (exit code {}): {}", program.purpose,
                                         program.name, exit_code, trim(errors.read())));
  return output.read();
}

}  // namespace base

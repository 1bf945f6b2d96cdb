#include "experiments/laboratory/host/jobs.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "simulator/machine/engine.hpp"
#include "simulator/machine/faults.hpp"

namespace laboratory {
namespace {

// A child process, and its output so far: one status byte, then the result or an error message.
struct Child {
  pid_t pid = -1;
  std::size_t index = 0;
  std::string text;
};

void write_all(int fd, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = write(fd, text.data() + at, text.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(1);
    at += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void run_child(pid_t parent, int fd, const Job& job, std::size_t index,
                            std::optional<base::HeldSignals>& held) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the kernel kills the child when its parent dies
  if (getppid() != parent) _exit(1);
  for (const int asked : ASKS_TO_END) signal(asked, [](int) { machine::request_stop(); });
  held.reset();
  std::string reply;
  try {
    reply = '\0' + job(index);
  } catch (const std::exception& error) {
    reply = static_cast<char>(exit_code_of(error)) + describe_error(error);
  }
  write_all(fd, reply);
  _exit(0);  // exits without calling the destructors of objects copied from the parent
}

class Pool {
 public:
  ~Pool() {
    const base::Undivided section;
    kill_all();
    for (const auto& [fd, child] : children_) close(fd);
    children_.clear();
  }

  void start(const Job& job, std::size_t index) {
    int ends[2];
    if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    const base::Undivided section;  // the child never leaves this critical section
    // blocks signals until the child has installed its own handlers
    std::optional<base::HeldSignals> held(ASKS_TO_END);
    const pid_t parent = getpid(), pid = fork();
    if (pid < 0) throw std::system_error(errno, std::generic_category(), "another process");
    if (pid == 0) {
      close(ends[0]);
      run_child(parent, ends[1], job, index, held);
    }
    close(ends[1]);
    children_[ends[0]] = {pid, index, {}};
  }

  // Waits until one of the children has ended.
  JobEnd wait_any() {
    for (;;) {
      std::vector<pollfd> fds;
      for (const auto& [fd, child] : children_) fds.push_back({fd, POLLIN, 0});
      const int ready = poll(fds.data(), fds.size(), 1000);
      if (count_interrupts() > 1) throw Interrupted();
      if (was_interrupted() && !std::exchange(stopping_, true)) stop_all();
      if (ready <= 0) continue;
      for (const auto& p : fds)
        if (p.revents != 0)
          if (auto ended = read_some(p.fd)) return std::move(*ended);
    }
  }

  std::size_t size() const { return children_.size(); }

 private:
  void stop_all() {
    for (const auto& [fd, child] : children_) kill(child.pid, SIGINT);
  }
  void kill_all() {
    for (const auto& [fd, child] : children_) {
      kill(child.pid, SIGKILL);
      waitpid(child.pid, nullptr, 0);
    }
  }

  std::optional<JobEnd> read_some(int fd) {
    char buffer[65536];
    const ssize_t n = read(fd, buffer, sizeof buffer);
    Child& child = children_.at(fd);
    if (n > 0) {
      child.text.append(buffer, static_cast<std::size_t>(n));
      return std::nullopt;
    }
    int status = 0;
    const base::Undivided section;
    waitpid(child.pid, &status, 0);
    close(fd);
    const Child ended = std::move(child);
    children_.erase(fd);
    if (WIFSIGNALED(status) || ended.text.empty())
      return JobEnd{ended.index, "",
                    fmt::format("its process ended abnormally ({})",
                                WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "no result")};
    std::string body = ended.text.substr(1);
    if (ended.text[0] != '\0') throw Failure(body, ended.text[0]);
    return JobEnd{ended.index, std::move(body), ""};
  }

  std::map<int, Child> children_;  // running children, by the reading end of their pipes
  bool stopping_ = false;
  const base::Undo undo_{[this] { kill_all(); }};
};

}  // namespace

void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended) {
  const InterruptGuard guard;
  Pool pool;
  std::size_t started = 0;
  for (;;) {
    while (!was_interrupted() && started < count &&
           pool.size() < std::max<std::size_t>(parallel, 1))
      pool.start(job, started++);
    if (pool.size() == 0) return;
    ended(pool.wait_any());
  }
}

int exit_code_of(const std::exception& error) {
  if (const auto* failure = dynamic_cast<const Failure*>(&error)) return failure->exit_code;
  if (dynamic_cast<const machine::Fault*>(&error)) return EXIT_FAULT;
  return dynamic_cast<const base::InvariantBroken*>(&error) ? EXIT_DEFECT : EXIT_INPUT;
}

}  // namespace laboratory

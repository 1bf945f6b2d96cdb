#include "experiments/laboratory/host/interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/early_end.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {
namespace {

constexpr char END_NOW = 'e', WORK_IS_DONE = 'd';

std::atomic<int> interrupts = 0, guards = 0;
std::atomic<pid_t> watched = 0;  // the process with a watch; 0: none. Children have none
int wake[2] = {-1, -1};          // a pipe to the thread that ends the program
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

void send(char what) {
  while (write(wake[1], &what, 1) < 0 && errno == EINTR) {
  }
}

void count_or_end(int) {
  const int error = errno;
  const int count = ++interrupts;
  if (watched == getpid() && (guards == 0 || count > 1)) {
    base::request_early_end();
    send(END_NOW);
  }
  errno = error;
}

void wait_for_end() {
  char what = END_NOW;
  while (read(wake[0], &what, 1) < 0 && errno == EINTR) {
  }
  if (what == WORK_IS_DONE) return;
  base::undo_all();
  complain(INTERRUPTED);
  // What was printed is whole, unless another thread is just printing.
  if (ftrylockfile(stdout) == 0) std::fflush(stdout);
  _exit(EXIT_INTERRUPTED);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  if (pipe2(wake, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  waits_ = std::thread(wait_for_end);
  watched = getpid();
  for (const int asked : ASKS_TO_END) std::signal(asked, &count_or_end);
}

InterruptWatch::~InterruptWatch() {
  {
    const base::Undivided section;
    watched = 0;
  }
  const base::Undivided unless_it_ends;  // a signal came while `watched` was still set
  send(WORK_IS_DONE);
  waits_.join();
  for (const int end : wake) close(end);
}

InterruptGuard::InterruptGuard() {
  interrupts = 0;
  ++guards;
  for (std::size_t i = 0; i < std::size(ASKS_TO_END); ++i)
    old_[i] = std::signal(ASKS_TO_END[i], &count_or_end);
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < std::size(ASKS_TO_END); ++i) std::signal(ASKS_TO_END[i], old_[i]);
  --guards;
}

int count_interrupts() { return interrupts; }

}  // namespace laboratory

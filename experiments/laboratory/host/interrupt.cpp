#include "experiments/laboratory/host/interrupt.hpp"

#include <fcntl.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <system_error>

#include "base/early_end.hpp"
#include "experiments/laboratory/host/streams.hpp"

namespace laboratory {
namespace {

constexpr char END_NOW = 'e', WORK_IS_DONE = 'd';

std::atomic<int> interrupts = 0, guards = 0;
// id of the process that has an InterruptWatch, or 0; a child process inherits this id but has no
// watch, and therefore compares the id with getpid()
std::atomic<pid_t> watched = 0;
int wake[2] = {-1, -1};  // pipe to the thread that ends the program
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

void send(char what) {
  while (write(wake[1], &what, 1) < 0 && errno == EINTR) {
  }
}

// the last signal that was counted, its sender, and its time in ns of the monotonic clock
std::atomic<int> last_signal = 0;
std::atomic<pid_t> last_sender = 0;
std::atomic<std::int64_t> last_ns = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

// True if a signal is a copy of the last one. A copy must not count as a second request. The
// command `timeout` sends each signal to its child and also to its process group. SIGHUP, from a
// closed terminal, never counts twice.
bool is_repeated(int signal, const siginfo_t& info) {
  constexpr std::int64_t AT_ONCE_NS = 100'000'000;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const auto now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  const pid_t sender = info.si_code == SI_USER ? info.si_pid : 0;
  const bool is_same = interrupts > 0 && last_signal == signal;
  const bool is_at_once = sender != 0 && sender == last_sender && now_ns - last_ns < AT_ONCE_NS;
  if (is_same && (signal == SIGHUP || is_at_once)) return true;
  last_signal = signal;
  last_sender = sender;
  last_ns = now_ns;
  return false;
}

void count_or_end(int signal, siginfo_t* info, void*) {
  const int error = errno;
  if (is_repeated(signal, *info)) return;
  const int count = ++interrupts;
  if (watched == getpid() && (guards == 0 || count > 1)) {
    base::request_early_end();
    send(END_NOW);
  }
  errno = error;
}

// Starts counting these signals. Leaves out signals that were ignored at program start, as under
// nohup or in background jobs of scripts. Returns the previous handlers.
Handlers begin_to_count() {
  Handlers old{};
  for (std::size_t i = 0; i < std::size(ASKS_TO_END); ++i) {
    struct sigaction counts {};
    counts.sa_sigaction = &count_or_end;
    counts.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(ASKS_TO_END[i], nullptr, &old[i]);
    if (old[i].sa_handler != SIG_IGN) sigaction(ASKS_TO_END[i], &counts, nullptr);
  }
  return old;
}

// True if a stream accepts output without blocking. False if another thread holds the stream's lock
// while it waits for output, or if the pipe is full.
bool is_free(FILE* stream) {
  constexpr int MOST_MS = 1000;
  if (ftrylockfile(stream) != 0) return false;
  pollfd written{fileno(stream), POLLOUT, 0};
  const bool is_ready = poll(&written, 1, MOST_MS) > 0;
  funlockfile(stream);
  return is_ready;
}

void wait_for_end() {
  char what = END_NOW;
  while (read(wake[0], &what, 1) < 0 && errno == EINTR) {
  }
  if (what == WORK_IS_DONE) return;
  base::undo_all();
  if (is_free(stderr)) complain(INTERRUPTED);
  if (is_free(stdout)) std::fflush(stdout);  // writes buffered output if that cannot block
  _exit(EXIT_INTERRUPTED);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  if (pipe2(wake, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  {
    // Blocks these signals in the new thread, so that the main thread receives and counts them.
    const base::HeldSignals held(ASKS_TO_END);
    waits_ = std::thread(wait_for_end);
  }
  watched = getpid();
  begin_to_count();
}

InterruptWatch::~InterruptWatch() {
  {
    const base::Undivided section;
    watched = 0;
  }
  // If a signal arrived before `watched` became 0, this statement blocks until the program has
  // ended.
  const base::Undivided unless_it_ends;
  send(WORK_IS_DONE);
  waits_.join();
  for (const int end : wake) close(end);
}

InterruptGuard::InterruptGuard() {
  interrupts = 0;
  ++guards;
  old_ = begin_to_count();
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < std::size(ASKS_TO_END); ++i)
    sigaction(ASKS_TO_END[i], &old_[i], nullptr);
  --guards;
}

int count_interrupts() { return interrupts; }

}  // namespace laboratory

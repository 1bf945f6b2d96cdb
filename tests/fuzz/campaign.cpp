#include "tests/fuzz/campaign.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <boost/core/demangle.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <typeinfo>

#include "base/errors.hpp"
#include "tests/support/isolated.hpp"

namespace fuzz {
namespace {

using Clock = std::chrono::steady_clock;

// number of cases for one child process
constexpr std::uint64_t BATCH = 500;

// Progress of a child process. It is in shared memory, so that it is not lost if the child crashes.
struct Progress {
  // number of the present case; between two cases, the number of the next one
  std::uint64_t next = 0;
  std::uint64_t accepted = 0, refused = 0;
  char what[2000] = "";
};

class SharedProgress {
 public:
  SharedProgress() {
    void* memory =
        mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share");
    progress_ = new (memory) Progress;
  }
  ~SharedProgress() { munmap(progress_, sizeof(Progress)); }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  Progress& operator*() { return *progress_; }

 private:
  Progress* progress_;
};

void limit_memory(const Limits& limits) {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  if (test::IS_SANITIZED) return;
  const rlimit memory{limits.memory_bytes, limits.memory_bytes};
  setrlimit(RLIMIT_AS, &memory);
}

void set_timer(__itimer_which kind, double seconds) {
  itimerval timer{};
  double whole = 0;
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * std::modf(seconds, &whole));
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  setitimer(kind, &timer, nullptr);
}

// Starts timers. Their signals end the child process if a case takes too long.
void begin_time(const Limits& limits) {
  set_timer(ITIMER_PROF, limits.cpu_s);
  set_timer(ITIMER_REAL, limits.wall_s);
}

void tell(Progress& progress, std::string_view what) {
  const auto size = std::min(what.size(), sizeof progress.what - 1);
  std::memcpy(progress.what, what.data(), size);
  progress.what[size] = '\0';
}

// True if the reader accepts the text, or refuses it by throwing base::BadInput.
bool run_case(const Reader& reader, const std::string& text, Progress& progress) {
  try {
    reader.read(text);
    ++progress.accepted;
  } catch (const base::BadInput&) {
    ++progress.refused;
  } catch (const std::exception& error) {
    tell(progress,
         fmt::format("{}: {}", boost::core::demangle(typeid(error).name()), error.what()));
    return false;
  } catch (...) {
    tell(progress, "throws what is no exception");
    return false;
  }
  return true;
}

std::string describe_end(int status, const Limits& limits) {
  if (!WIFSIGNALED(status)) return fmt::format("ended with {}", WEXITSTATUS(status));
  if (WTERMSIG(status) == SIGPROF)
    return fmt::format("takes more than {} s of the processor", limits.cpu_s);
  if (WTERMSIG(status) == SIGALRM) return fmt::format("takes more than {} s", limits.wall_s);
  return strsignal(WTERMSIG(status));
}

// Executes cases until the reader fails.
[[noreturn]] void run_child(const Trial& trial, std::uint64_t end, const Campaign& campaign,
                            Progress& progress) {
  limit_memory(campaign.limits);
  for (; progress.next < end; ++progress.next) {
    const std::string text = make_case(trial, campaign.seed, progress.next);
    begin_time(campaign.limits);
    if (!run_case(trial.reader, text, progress)) _exit(1);
  }
  _exit(0);  // exits without calling the destructors of objects copied from the parent
}

}  // namespace

std::string make_case(const Trial& trial, std::uint64_t seed, std::uint64_t number) {
  std::uint64_t key = seed;
  for (const char c : trial.reader.name) key = base::random_at(key, static_cast<unsigned char>(c));
  base::Random random(base::random_at(key, number));
  return mutate(trial.corpus, random);
}

void run_batch(Trial& trial, std::uint64_t cases, const Campaign& campaign) {
  const auto begin = Clock::now();
  const std::uint64_t end = trial.next + cases;
  SharedProgress shared;
  Progress& progress = *shared;
  progress.next = trial.next;
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("no child process");
  if (pid == 0) run_child(trial, end, campaign, progress);
  int status = 0;
  waitpid(pid, &status, 0);
  trial.counts.accepted += progress.accepted;
  trial.counts.refused += progress.refused;
  trial.counts.cases += progress.next - trial.next;
  trial.next = progress.next;
  trial.wall_s += std::chrono::duration<double>(Clock::now() - begin).count();
  if (trial.next == end) return;
  ++trial.next;
  ++trial.counts.cases;
  ++trial.counts.findings;
  campaign.tell(trial, {progress.next,
                        *progress.what ? progress.what : describe_end(status, campaign.limits)});
}

void run_number(std::vector<Trial>& trials, std::uint64_t cases, const Campaign& campaign) {
  for (auto& trial : trials)
    while (trial.next < cases && trial.counts.findings < MOST_FINDINGS)
      run_batch(trial, std::min(BATCH, cases - trial.next), campaign);
}

void run_hours(std::vector<Trial>& trials, double hours, const Campaign& campaign) {
  const auto end = Clock::now() + std::chrono::duration<double>(3600 * hours);
  while (Clock::now() < end) {
    Trial* least = nullptr;
    for (auto& trial : trials)
      if (trial.counts.findings < MOST_FINDINGS && (!least || trial.wall_s < least->wall_s))
        least = &trial;
    if (!least) return;
    run_batch(*least, BATCH, campaign);
  }
}

}  // namespace fuzz

#include "tests/fuzz/campaign.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <boost/core/demangle.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <typeinfo>

#include "base/errors.hpp"
#include "tests/support/isolated.hpp"

namespace fuzz {
namespace {

// What a child tells even if it crashes: it is in memory that the parent shares.
struct Progress {
  std::uint64_t next = 0;  // the case that is being read, or the first that is not run
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

// A signal ends the child where a case takes longer.
void begin_time(const Limits& limits) {
  itimerval timer{};
  double whole = 0;
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * std::modf(limits.cpu_s, &whole));
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(limits.wall_s);
}

void tell(Progress& progress, std::string_view what) {
  const auto size = std::min(what.size(), sizeof progress.what - 1);
  std::memcpy(progress.what, what.data(), size);
  progress.what[size] = '\0';
}

// Whether the reader stands it.
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

}  // namespace

std::string make_case(const Reader& reader, const Corpus& corpus, std::uint64_t seed,
                      std::uint64_t number) {
  std::uint64_t key = seed;
  for (const char c : reader.name) key = base::random_at(key, static_cast<unsigned char>(c));
  base::Random random(base::random_at(key, number));
  return mutate(corpus, random);
}

std::optional<Finding> run_cases(const Reader& reader, const Corpus& corpus, std::uint64_t seed,
                                 std::uint64_t first, std::uint64_t cases, const Limits& limits,
                                 Counts& counts) {
  SharedProgress shared;
  Progress& progress = *shared;
  progress.next = first;
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("no child process");
  if (pid == 0) {
    limit_memory(limits);
    for (; progress.next < first + cases; ++progress.next) {
      const std::string text = make_case(reader, corpus, seed, progress.next);
      begin_time(limits);
      if (!run_case(reader, text, progress)) _exit(1);
    }
    _exit(0);  // without the parent's destructors
  }
  int status = 0;
  waitpid(pid, &status, 0);
  counts.accepted += progress.accepted;
  counts.refused += progress.refused;
  counts.cases += progress.next - first;
  if (progress.next == first + cases) return std::nullopt;
  ++counts.cases;
  ++counts.findings;
  return Finding{progress.next, *progress.what ? progress.what : describe_end(status, limits)};
}

}  // namespace fuzz

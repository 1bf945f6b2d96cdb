#pragma once
// Timing for the benchmarks: host CPU time of one thread, the best of several runs, and what the
// figures were measured on. Speeds are only meaningful as ratios within one run.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace benchmarks {

struct Sample {
  std::uint64_t count = 0;  // what was done: rays, hops, ...
  double cpu_s = 0;         // host CPU time it took
  double simulated_s = 0;   // of a simulation: when it ended
  double rate() const { return static_cast<double>(count) / cpu_s; }
};

// Host CPU time used by this process, in seconds: waiting for the CPU does not count.
inline double cpu_time_s() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Body>
double time_of(Body&& body) {
  const double start = cpu_time_s();
  body();
  return cpu_time_s() - start;
}

template <class Run>
Sample best_of(int runs, Run&& run) {
  Sample best = run();
  for (int i = 1; i < runs; ++i) {
    const Sample next = run();
    if (next.rate() > best.rate()) best = next;
  }
  return best;
}

// The run in a process of its own: SimGrid allows one simulation a process.
template <class Run>
Sample in_child(Run&& run) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a child process");
  std::fflush(stdout);  // or the child would print it again
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    int status = 1;
    try {
      const Sample sample = run();
      status = write(ends[1], &sample, sizeof sample) == sizeof sample ? 0 : 1;
    } catch (const std::exception& failure) {
      fmt::print(stderr, "{}\n", failure.what());
    }
    _exit(status);
  }
  close(ends[1]);
  Sample sample;
  const bool whole = read(ends[0], &sample, sizeof sample) == sizeof sample;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!whole || status != 0) throw std::runtime_error("a child process failed");
  return sample;
}

// "AMD EPYC, 2 cores; load 0.31 when it began"
inline std::string host() {
  std::string model = "unknown CPU", line;
  for (std::ifstream info("/proc/cpuinfo"); std::getline(info, line);)
    if (line.starts_with("model name")) model = line.substr(line.find(':') + 2);
  double load = 0;
  std::ifstream("/proc/loadavg") >> load;
  return fmt::format("{}, {} cores; load {:.2f} when it began", model,
                     sysconf(_SC_NPROCESSORS_ONLN), load);
}

// Lines of the table that a program ends with, and `run` collects.
class Ratios {
 public:
  void add(const std::string& what, double ratio) {
    lines_ += fmt::format("ratio  {:64} {:7.2f}\n", what, ratio);
  }
  void print() const { fmt::print("\n{}", lines_); }

 private:
  std::string lines_;
};

}  // namespace benchmarks

#pragma once
// Measures host CPU time and memory. Measured speeds have a meaning only as ratios between programs
// in the same run.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace benchmarks {

struct Sample {
  std::uint64_t count = 0;   // amount of work, such as the number of rays or hops
  double cpu_s = 0;          // host CPU time for this work, seconds
  double simulated_s = 0;    // simulated time at the end of a simulation, seconds
  double memory_kb = 0;      // increase of the resident memory in KB, if measured
  std::uint64_t events = 0;  // number of events that the machine handled; 0: not counted
  // For a machine that several threads simulate: number of time windows in which the threads work
  // independently, and number of events on links between the threads' parts.
  std::uint64_t windows = 0, events_between = 0;
};

// Host CPU time of this process in seconds. Time in which the process waits for the CPU does not
// count.
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

// Measures elapsed time instead of CPU time, for work that several threads share.
template <class Body>
double wall_time_of(Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Resident memory of this process in KB.
inline double memory_kb() {
  double all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024;
}

// Calls `run` in a child process, and returns the vector that it returns. SimGrid allows only one
// simulation for each process.
template <class Run>
auto list_of_child(Run&& run) {
  using List = std::invoke_result_t<Run>;
  using Item = typename List::value_type;
  static_assert(std::is_trivially_copyable_v<Item>);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a child process");
  std::fflush(nullptr);  // prevents the child from printing the buffered output a second time
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    int status = 1;
    try {
      const List list = run();
      std::FILE* to = fdopen(ends[1], "w");
      const bool whole = std::fwrite(list.data(), sizeof(Item), list.size(), to) == list.size();
      status = whole && std::fclose(to) == 0 ? 0 : 1;
    } catch (const std::exception& failure) {
      fmt::print(stderr, "{}\n", failure.what());
    }
    _exit(status);
  }
  close(ends[1]);
  std::FILE* from = fdopen(ends[0], "r");
  List list;
  for (Item item; std::fread(&item, sizeof item, 1, from) == 1;) list.push_back(item);
  std::fclose(from);
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) throw std::runtime_error("a child process failed");
  return list;
}

template <class Run>
Sample in_child(Run&& run) {
  return list_of_child([&] { return std::vector<Sample>{run()}; }).at(0);
}

}  // namespace benchmarks

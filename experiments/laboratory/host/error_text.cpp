#include "experiments/laboratory/host/error_text.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "base/partial_name.hpp"

namespace laboratory {
namespace {

// bytes, freed when memory is exhausted: enough to unwind the stack and to report the error
constexpr std::size_t RESERVE = std::size_t{2} << 20;

std::atomic<void*> reserve = nullptr;
pid_t main_process = 0;
std::terminate_handler other_terminate = nullptr;

void release_reserve() {
  std::free(reserve.exchange(nullptr));
  throw std::bad_alloc();
}

bool is_out_of_memory() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
  }
  return false;
}

// True if the limit on the address space (ulimit -v) leaves no room for the stack of a thread.
bool has_little_memory() {
  constexpr rlim_t ROOM = rlim_t{32} << 20;
  rlimit most{};
  unsigned long long pages = 0;
  if (getrlimit(RLIMIT_AS, &most) != 0 || most.rlim_cur == RLIM_INFINITY) return false;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + ROOM > most.rlim_cur;
}

[[noreturn]] void terminate() {
  constexpr int NO_RESOURCES = 2;
  if (!is_out_of_memory()) other_terminate();
  // Child processes have copies of the parent's clean-up actions. Only the parent may run them.
  if (getpid() == main_process) {
    base::undo_all();
    for (const std::string_view part : {"tlab: ", NO_MEMORY, "\n"})
      if (write(STDERR_FILENO, part.data(), part.size()) < 0) break;
  }
  _exit(NO_RESOURCES);
}

}  // namespace

std::string describe_error(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error))
    return NO_MEMORY;
  if (const auto* files = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const auto path = base::find_final_path(files->path1()).string();
    return fmt::format("{}: {}", path.empty() ? "the current folder" : path,
                       files->code().message());
  }
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again)
    return has_little_memory() ? NO_MEMORY
                               : "the host refuses another process or thread, expected higher "
                                 "limits (ulimit -u, -v), or "
                                 "fewer --jobs and --threads";
  if (dynamic_cast<const nlohmann::json::exception*>(&error))
    return "found damaged JSON, expected a file that tlab has written";
  return error.what();
}

void secure_stack() {
  constexpr rlim_t ENOUGH = rlim_t{8} << 20, LEAST = rlim_t{1} << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= ENOUGH) return;
  limit.rlim_cur = std::min(limit.rlim_max, ENOUGH);
  base::require(limit.rlim_cur >= LEAST, "the stack",
                "found a limit of {} KiB, expected at least {} KiB (ulimit -s)",
                limit.rlim_cur >> 10, LEAST >> 10);
  // The kernel observes the new limit when the stack of the main thread grows. The C library has
  // already taken the size of other threads' stacks from the old limit.
  pthread_attr_t attributes;
  setrlimit(RLIMIT_STACK, &limit);
  pthread_getattr_default_np(&attributes);
  pthread_attr_setstacksize(&attributes, limit.rlim_cur);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

void secure_memory() {
  if (main_process != 0) return;
  main_process = getpid();
  reserve = std::malloc(RESERVE);
  std::set_new_handler(release_reserve);
  other_terminate = std::set_terminate(terminate);
}

}  // namespace laboratory

#include <signal.h>
#include <unistd.h>

#include <string_view>

#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/host/interrupt.hpp"

#ifdef __has_feature
#define HAS_FEATURE(x) __has_feature(x)
#else
#define HAS_FEATURE(x) 0
#endif

// This code is left out of builds with sanitizers. They intercept functions that it calls, but are
// not yet initialised when .preinit_array runs.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !HAS_FEATURE(address_sanitizer) && !HAS_FEATURE(thread_sanitizer)
namespace {

void end_early(int) {
  constexpr std::string_view HEAD = "tlab: ", TEXT = laboratory::INTERRUPTED;
  for (const auto part : {HEAD, TEXT, std::string_view("\n")})
    if (write(STDERR_FILENO, part.data(), part.size()) < 0) break;
  _exit(laboratory::EXIT_INTERRUPTED);
}

// Handles signals already while the libraries initialise their static objects, which may take a
// while. The handler only prints a message and exits, since there are no files to remove yet.
void handle_signals() {
  for (const int asked : laboratory::ASKS_TO_END) {
    struct sigaction now {};
    if (sigaction(asked, nullptr, &now) == 0 && now.sa_handler == SIG_DFL)
      signal(asked, &end_early);
  }
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_all)() = &handle_signals;

}  // namespace
#endif

int main(int argc, char** argv) { return laboratory::run_tlab(argc, argv); }

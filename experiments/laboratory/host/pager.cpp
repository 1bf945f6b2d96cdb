#include "experiments/laboratory/host/pager.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "base/host_program.hpp"
#include "base/message.hpp"

namespace laboratory {
namespace {

bool is_shown_by(const std::string& pager, const std::string& text) try {
  std::fflush(stdout);
  base::run_program({.name = "sh",
                     .arguments = {"-c", pager},
                     .input = text,
                     .purpose = "help",
                     .remedy = "",
                     .shows_output = true});
  return true;
} catch (const std::runtime_error&) {
  return false;
}

}  // namespace

void print_paged(const std::string& given_text) {
  const auto text = base::show_controls(given_text);
  if (isatty(STDOUT_FILENO)) {
    const char* given = std::getenv("PAGER");
    setenv("LESS", "FRX", 0);  // less exits at once if the text fits, and leaves it on the screen
    if (is_shown_by(given && *given ? given : "less", text)) return;
  }
  fmt::print("{}", text);
}

}  // namespace laboratory

#include "experiments/laboratory/host/streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "base/host_program.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/host/colour.hpp"

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

void secure_streams() {
  for (const int ends_the_program : {SIGPIPE, SIGXFSZ}) std::signal(ends_the_program, SIG_IGN);
  // Opens closed streams for reading only, so that writing to them still fails, as the caller
  // expects.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0)
      throw std::system_error(errno, std::generic_category(), "/dev/null");
}

void wait_for_error_stream() {
  pollfd written{STDERR_FILENO, POLLOUT, 0};
  poll(&written, 1, -1);
}

void print_on_error(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

namespace {

[[noreturn]] void fail_to_write() {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(),
                          "cannot write standard output");
}

// Prints a line on standard error. On a terminal it overwrites the progress bar.
void print_behind(std::string_view head, std::string_view text) {
  const auto* const begin = obeys_escapes(stderr) ? "\r\x1b[K" : "";
  print_on_error(fmt::format("{}{}{}\n", begin, head, base::make_readable(text)));
}

}  // namespace

void print_line(std::string_view text) { print_behind("", text); }

void complain(std::string_view text) {
  print_behind(paint("tlab:", Tone::bad, stderr).text + " ", text);
}

std::size_t output_width() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return size.ws_col;
  return 120;
}

void write_output(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size()) fail_to_write();
}

void flush_output() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) fail_to_write();
}

void print_paged(const std::string& given_text) {
  const auto text = base::show_controls(given_text);
  if (isatty(STDOUT_FILENO)) {
    const char* given = std::getenv("PAGER");
    setenv("LESS", "FRX", 0);  // if the text fits, exits and leaves it on the screen
    if (is_shown_by(given && *given ? given : "less", text)) return;
  }
  write_output(text);
}

}  // namespace laboratory

// Executes a part of a test on a terminal.
#pragma once

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <string>

namespace laboratory {

/// Executes `body` in a process of its own whose streams are a terminal, and returns the output.
/// Lines end with "\r\n".
inline std::string on_terminal(const std::function<void()>& body) {
  std::fflush(nullptr);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    body();
    std::fflush(nullptr);
    _exit(0);
  }
  std::string text;
  char bytes[4096];
  for (ssize_t n; (n = ::read(terminal, bytes, sizeof bytes)) > 0;)
    text.append(bytes, static_cast<std::size_t>(n));
  close(terminal);
  waitpid(child, nullptr, 0);
  return text;
}

}  // namespace laboratory

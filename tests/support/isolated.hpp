#pragma once
// Execution of a part of a test in a child process, since SimGrid's engine is a singleton.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace test {

/// True if the address sanitizer is active. It does not know the stacks of SimGrid's actors, and
/// reports false errors when exceptions pass through them. Such tests are skipped.
#ifdef __SANITIZE_ADDRESS__
constexpr bool IS_SANITIZED = true;
#else
constexpr bool IS_SANITIZED = false;
#endif

/// The exception that ended a child process: its message, and its type, such as "base::BadInput".
struct ChildThrew : std::runtime_error {
  ChildThrew(std::string type, const std::string& what)
      : std::runtime_error(what), type(std::move(type)) {}
  std::string type;
};

/// The text that `body` returns in a child process. Assertions that fail in the child fail the test
/// here, with their files and lines. Throws ChildThrew for an exception of `body`. Throws
/// std::runtime_error for a child that dies, or that has not ended after `limit_s` seconds.
std::string isolated(const std::function<std::string()>& body, unsigned limit_s = 120);

/// Runs `body` in a child process only for its assertions.
void run_isolated(const std::function<void()>& body);

/// The numbers that `body` returns in a child process, with all their bits.
std::vector<double> isolated_numbers(const std::function<std::vector<double>()>& body);

}  // namespace test

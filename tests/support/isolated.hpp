#pragma once
// Executes a part of a test in a child process, because SimGrid's engine is a singleton.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace test {

/// True if the address sanitizer is active. It does not know the stacks of SimGrid's actors, and
/// reports false errors if an exception passes through them. Tests in which this happens are
/// skipped.
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

/// Calls `body` in a child process, and returns the text that it returns. An assertion that fails
/// in the child fails this test too, with file and line. Throws ChildThrew if `body` throws an
/// exception. Throws std::runtime_error if the child dies, or has not ended after `limit_s`
/// seconds.
std::string isolated(const std::function<std::string()>& body, unsigned limit_s = 120);

/// Calls `body` in a child process, only for its assertions.
void run_isolated(const std::function<void()>& body);

/// Calls `body` in a child process, and returns the numbers that it returns, exactly.
std::vector<double> isolated_numbers(const std::function<std::vector<double>()>& body);

}  // namespace test

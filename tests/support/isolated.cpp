#include "tests/support/isolated.hpp"

#include <fmt/format.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/core/demangle.hpp>
#include <cstdio>
#include <cstring>
#include <optional>

namespace test {
namespace {

// A child process sends the failed assertions first, and then its result or exception. Each of
// these messages consists of a letter, the lengths of two texts, and the two texts.
constexpr char FAILURE = 'f', RETURNED = 'r', THREW = 't';

void write_part(std::FILE* out, char kind, const std::string& first, const std::string& second) {
  fmt::print(out, "{} {} {} {}{}", kind, first.size(), second.size(), first, second);
  std::fflush(out);
}

[[noreturn]] void run_child(int fd, const std::function<std::string()>& body, unsigned limit_s) {
  alarm(limit_s);
  std::FILE* out = fdopen(fd, "w");
  // collects failures without printing them, because the parent reports them
  testing::TestPartResultArray failures;
  const testing::ScopedFakeTestPartResultReporter reporter(
      testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
  const auto write_end = [&](char kind, const std::string& first, const std::string& second) {
    for (int i = 0; i < failures.size(); ++i) {
      const auto& part = failures.GetTestPartResult(i);
      const char* file = part.file_name() ? part.file_name() : "";
      const auto place = fmt::format("{}:{}", part.line_number(), file);
      if (part.failed()) write_part(out, FAILURE, place, part.message());
    }
    write_part(out, kind, first, second);
  };
  try {
    write_end(RETURNED, "", body());
  } catch (const std::exception& error) {
    write_end(THREW, boost::core::demangle(typeid(error).name()), error.what());
  }
  _exit(0);  // exits without calling the destructors of objects copied from the parent
}

struct Part {
  char kind;
  std::string first, second;
};

std::optional<Part> read_part(std::FILE* in) {
  Part part{};
  std::size_t first = 0, second = 0;
  if (std::fscanf(in, "%c %zu %zu", &part.kind, &first, &second) != 3) return std::nullopt;
  std::fgetc(in);
  part.first.resize(first);
  part.second.resize(second);
  if (std::fread(part.first.data(), 1, first, in) != first) return std::nullopt;
  if (std::fread(part.second.data(), 1, second, in) != second) return std::nullopt;
  return part;
}

}  // namespace

std::string isolated(const std::function<std::string()>& body, unsigned limit_s) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("no child process");
  if (pid == 0) {
    close(ends[0]);
    run_child(ends[1], body, limit_s);
  }
  close(ends[1]);
  std::FILE* in = fdopen(ends[0], "r");
  std::optional<Part> last;
  while (auto part = read_part(in)) {
    if (part->kind == FAILURE) {
      const auto colon = part->first.find(':');
      ADD_FAILURE_AT(part->first.c_str() + colon + 1, std::stoi(part->first)) << part->second;
    } else {
      last = std::move(part);
    }
  }
  std::fclose(in);
  int status = 0;
  waitpid(pid, &status, 0);
  if (!last)
    throw std::runtime_error(fmt::format(
        "the child ended without a result ({})",
        WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : std::to_string(WEXITSTATUS(status))));
  if (last->kind == THREW) throw ChildThrew(last->first, last->second);
  return last->second;
}

void run_isolated(const std::function<void()>& body) {
  isolated([&] {
    body();
    return std::string();
  });
}

std::vector<double> isolated_numbers(const std::function<std::vector<double>()>& body) {
  const std::string bytes = isolated([&] {
    const auto numbers = body();
    return std::string(reinterpret_cast<const char*>(numbers.data()),
                       numbers.size() * sizeof(double));
  });
  std::vector<double> numbers(bytes.size() / sizeof(double));
  if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace test

#include "base/host_program.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/files.hpp"

namespace base {
namespace {

HostProgram shell(const std::string& script, const std::string& input = "") {
  return {.name = "sh",
          .arguments = {"-c", script, "sh", "two words", "$HOME'"},
          .input = input,
          .purpose = "plot p",
          .remedy = "install it"};
}

std::string failure_of(const HostProgram& program) {
  return test::message_of<std::runtime_error>([&] { run_program(program); });
}

TEST(HostProgram, ReadsItsInputAndArgumentsAsTheyAre) {
  EXPECT_EQ(run_program(shell("cat; echo \"$1|$2\"; echo quiet >&2", "in\n")),
            "in\ntwo words|$HOME'\n");
}

// Transfers more data than the buffer of a pipe holds: in both directions, and to a program that
// reads no input.
TEST(HostProgram, TakesMuchInputAndOutput) {
  const std::string much(3 << 20, 'x');
  EXPECT_EQ(run_program(shell("cat", much)), much);
  EXPECT_EQ(run_program(shell("exit 0", much)), "");
}

TEST(HostProgram, FailuresCarryTheCodeAndWhatTheProgramSays) {
  EXPECT_EQ(failure_of(shell("echo why >&2; exit 3")), "plot p: sh failed (exit code 3): why");
  EXPECT_NE(failure_of(shell("kill -9 $$")), "");
}

TEST(HostProgram, MissingProgramsComeWithTheRemedy) {
  auto missing = shell("");
  missing.name = "no-such-program";
  EXPECT_EQ(failure_of(missing),
            "plot p: drawing needs the program no-such-program, which was not found: install it");
}

// Several threads start programs at the same time. A pipe signals that a program has started. If
// another program inherited this pipe, the start would seem to last until that program ends.
TEST(HostProgram, StartsDoNotWaitForOtherProgramsToEnd) {
  const HostProgram program{.name = "find",
                            .arguments = {"/proc/self/fd", "-lname", "pipe:*"},
                            .purpose = "test",
                            .remedy = "install findutils"};
  const std::string alone = run_program(program);
  std::vector<std::jthread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k) EXPECT_EQ(run_program(program), alone);
    });
}

}  // namespace
}  // namespace base

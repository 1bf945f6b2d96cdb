// Tasks in child processes: their results and failures, and killed processes.
#include "experiments/laboratory/host/jobs.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <map>

#include "base/early_end.hpp"
#include "experiments/laboratory/host/interrupt.hpp"
#include "tests/support/isolated.hpp"

namespace laboratory {
namespace {

TEST(ExperimentsJobs, ResultsOfAnyLengthComeBack) {
  std::map<std::size_t, std::string> results;
  for_each_job(
      7, 3, [](std::size_t i) { return std::string(i * 100'000, char('a' + i)); },
      [&](const JobEnd& end) { results[end.index] = end.result; });
  ASSERT_EQ(results.size(), 7u);
  for (const auto& [i, result] : results)
    EXPECT_EQ(result, std::string(i * 100'000, char('a' + i)));
}

TEST(ExperimentsJobs, AProcessThatIsKilledDoesNotStopTheOthers) {
  std::map<std::size_t, JobEnd> ends;
  const Job job = [](std::size_t i) {
    if (i == 1) raise(SIGKILL);
    return std::to_string(i);
  };
  for_each_job(4, 2, job, [&](JobEnd end) { ends[end.index] = end; });
  ASSERT_EQ(ends.size(), 4u);
  for (const auto& [i, end] : ends) {
    EXPECT_EQ(end.died, i == 1 ? "its process ended abnormally (Killed)" : "");
    EXPECT_EQ(end.result, i == 1 ? "" : std::to_string(i));
  }
}

TEST(ExperimentsJobs, AnExceptionEndsTheOthers) {
  try {
    for_each_job(
        4, 2,
        [](std::size_t i) -> std::string {
          if (i == 2) throw std::runtime_error("no such scene");
          return "";
        },
        [](const JobEnd& end) { EXPECT_NE(end.index, 2u); });
    FAIL() << "nothing was thrown";
  } catch (const Failure& failed) {
    EXPECT_STREQ(failed.what(), "no such scene");
    EXPECT_EQ(failed.exit_code, 2);
  }
}

// The main thread counts an interrupt before it reads a message of a child. If another thread got
// the signal, it would be counted too late.
TEST(ExperimentsJobs, AnInterruptIsCountedByTheMainThread) {
  test::run_isolated([] {
    std::signal(SIGINT, SIG_DFL);  // the tests may have started with SIGINT ignored
    const InterruptWatch watch;
    const InterruptGuard guard;
    {
      const base::HeldSignals held(ASKS_TO_END);
      kill(getpid(), SIGINT);
      usleep(100'000);
      EXPECT_EQ(count_interrupts(), 0);
    }
    EXPECT_EQ(count_interrupts(), 1);
  });
}

}  // namespace
}  // namespace laboratory

// The option --threads of `tlab run`.
#include "tests/laboratory/support/one_point.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

TEST(ThreadsOption, LeavesTheResultsAsTheyAre) {
  const TemporaryFolder folder;
  write_file(folder.path / "e.toml",
             "[program]\nname = \"traffic\"\nwindow_s = 0.01\n"
             "[network]\ntopology = \"mesh:8x8\"\n[sweep]\nload = [0.1, 0.4]\n"
             "[run]\nengine = \"direct\"\n");
  const auto results_of = [&](const std::string& threads) {
    const auto outcome = tlab(folder.path, {"run", "e.toml", "--threads", threads, "-o", threads});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_file(folder.path / threads / "results.csv");
  };
  const auto on_one = results_of("1");
  for (const char* threads : {"2", "4", "8", "16"})
    EXPECT_EQ(results_of(threads), on_one) << threads;
}

TEST(ThreadsOption, MoreThanTheHostRunsAreReported) {
  const TemporaryFolder folder;
  write_file(folder.path / "e.toml",
             "[program]\nname = \"traffic\"\nwindow_s = 1e-4\n"
             "[network]\ntopology = \"ring:4\"\n[run]\nengine = \"direct\"\n");
  const auto outcome = tlab(folder.path, {"run", "e.toml", "--threads", "1024"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.err, "--threads: found 1024, but this computer runs "))
      << outcome.err;
}

TEST(ThreadsOption, IsRefusedWhereAPointRunsOnOne) {
  const TemporaryFolder folder;
  const auto error_of = [&](std::vector<std::string> arguments) {
    const auto outcome = tlab(folder.path, std::move(arguments));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"e.toml"}) << "nothing is written";
    return outcome.err;
  };
  write_file(folder.path / "e.toml", "[program]\nname = \"law\"\n[network]\ntopology = \"ring\"\n");
  EXPECT_TRUE(contains(error_of(one_point({"--threads", "2"})),
                       "--threads: found 2 with the program farm, which supports only one, "
                       "expected one of unicast, "));
  EXPECT_TRUE(contains(error_of({"run", "e.toml", "--threads", "2"}),
                       "--threads: found 2 with run.engine = \"simgrid\", expected"));
  EXPECT_TRUE(contains(error_of({"run", "e.toml", "--threads", "2", "--set", "run.engine=direct",
                                 "--timeline", "t.svg"}),
                       "--threads: found 2 with a trace, a time line or a film, expected one"));
  EXPECT_TRUE(contains(error_of({"run", "e.toml", "--threads", "0"}), "--threads"));
}

}  // namespace
}  // namespace laboratory

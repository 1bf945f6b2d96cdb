// Tests the command when standard output or standard error cannot be written, and under a disk
// quota.
#include "tests/laboratory/support/sweep.hpp"
#include "tests/support/places.hpp"

namespace laboratory {
namespace {

TEST_F(Sweep, OutputThatCannotBeWrittenIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const auto told = folder.path / "told";
  for (const char* line : {"--help", "--version", "run --help", "topology ring:4", "model t805-25",
                           "list", "columns", "run e.toml -o r"}) {
    const auto command = std::string("$TLAB ") + line;
    EXPECT_EQ(run_line(folder.path, command + " > /dev/full 2> told"), 2) << line;
    EXPECT_EQ(read_file(told), "tlab: cannot write standard output: No space left on device\n")
        << line;
    EXPECT_EQ(run_line(folder.path, command + " >&- 2> told"), 2) << line;
    EXPECT_TRUE(contains(read_file(told), "Bad file descriptor")) << read_file(told);
  }
  EXPECT_EQ(visible("r").count("report.html"), 1u) << "the results are there all the same";
  EXPECT_EQ(read_file(folder.path / "r/results.csv").find("Ended:"), std::string::npos);
}

TEST_F(Sweep, ErrorsThatNobodyCanReadHaveTheirExitCodes) {
  std::ofstream(folder.path / "fails.toml") << "[program]\nname = \"deadlock\"\n[sweep]\n"
                                               "\"model.cpu.clock\" = [20e6, 25e6]\n";
  for (const char* error : {"2> /dev/full", "2>&-"})
    for (const auto& [line, exit_code] :
         {std::pair("$TLAB run missing.toml", 2), std::pair("$TLAB", 2), std::pair("$TLAB run", 2),
          std::pair("$TLAB run fails.toml -o r", 3), std::pair("$TLAB run e.toml -o s", 0)})
      EXPECT_EQ(run_line(folder.path, std::string(line) + " > out " + error), exit_code)
          << line << error;
  EXPECT_EQ(
      folder.names(),
      (Arguments{"e.toml", "fails.toml", "out", "r-fault-cpu.clock-20000000.0-timeline.svg",
                 "r-fault-cpu.clock-20000000.0.svg", "r-fault-cpu.clock-25000000.0-timeline.svg",
                 "r-fault-cpu.clock-25000000.0.svg", "s"}));
}

// The reader closes the pipe early, as in `tlab ... | head -1`. The exit code 141 is 128 + SIGPIPE.
TEST_F(Sweep, AReaderWhoHasReadEnoughIsToldNothing) {
  EXPECT_EQ(run_line(folder.path,
                     "mkfifo p && { : < p & } && exec 4> p && wait && $TLAB columns >&4 2> told"),
            141);
  EXPECT_EQ(read_file(folder.path / "told"), "");
}

TEST_F(Sweep, AQuotaOfFilesSizesIsAnErrorAndLeavesNothingBehind) {
  for (const char* blocks : {"0", "1", "8"}) {
    const auto line = std::string("(ulimit -f ") + blocks + "; $TLAB run e.toml -o q) > /dev/null";
    EXPECT_EQ(run_line(folder.path, line + " 2>&1"), 2) << blocks;
    for (const auto& name : folder.names()) EXPECT_TRUE(name == "e.toml" || name == "q") << name;
  }
  EXPECT_EQ(run({"-o", "q"}).exit_code, 0);
}

}  // namespace
}  // namespace laboratory

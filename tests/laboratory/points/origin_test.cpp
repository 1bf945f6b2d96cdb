// The command that makes results again, as reports and run.json show it.
#include "experiments/laboratory/points/origin.hpp"

#include <gtest/gtest.h>

#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

// A shell splits the command into its arguments, whatever characters they have.
TEST(Origin, ItsCommandIsQuotedForAShell) {
  const TemporaryFolder folder;
  RunOptions options;
  for (const std::string file :
       {"plain-1.toml", "a b.toml", "it's $(x) `y` \\n \"z\".toml", "\\n'\n\\\t\x1b[31m $x.toml"}) {
    options.file = file;
    write_file(folder.path / "command", "tlab() { printf %s \"$2\"; }\n" + command_line(options));
    EXPECT_EQ(run_line(folder.path, "bash command > second"), 0);
    EXPECT_EQ(read_file(folder.path / "second"), file);
  }
}

}  // namespace
}  // namespace laboratory

// Coloured output on a terminal, and plain output elsewhere.
#include <unistd.h>

#include "tests/laboratory/support/sweep.hpp"
#include "tests/laboratory/support/terminal.hpp"
#include "tests/support/places.hpp"

namespace laboratory {
namespace {

// The output of `tlab run e.toml` on a terminal, with `settings` as environment variables.
std::string run_on_terminal(const std::filesystem::path& folder,
                            const std::vector<std::pair<const char*, const char*>>& settings) {
  const auto program = ::test::in_build("tlab");
  return on_terminal([&] {
    for (const auto& [name, value] : settings) setenv(name, value, 1);
    if (chdir(folder.c_str()) == 0)
      execl(program.c_str(), "tlab", "run", "e.toml", "-o", "r", nullptr);
    _exit(127);
  });
}

// True if the text has colours or bold letters, which end with this escape sequence.
bool has_colour(const std::string& text) { return contains(text, "\x1b[0m"); }

TEST_F(Sweep, ColourIsForTerminalsThatWantIt) {
  std::ofstream(folder.path / "e.toml") << SWEEP << "[report]\ncolumns = [\"none\"]\n";
  const auto text = run_on_terminal(folder.path, {{"TERM", "xterm"}, {"NO_COLOR", ""}});
  EXPECT_TRUE(contains(text, "\x1b[32mok\x1b[0m")) << text;
  EXPECT_TRUE(contains(text, "\x1b[33mnote:\x1b[0m")) << text;
  const auto plain = run_on_terminal(folder.path, {{"TERM", "xterm"}, {"NO_COLOR", "1"}});
  EXPECT_TRUE(contains(plain, "ok       c: rays")) << plain;
  EXPECT_FALSE(has_colour(plain)) << plain;
  const auto dumb = run_on_terminal(folder.path, {{"TERM", "dumb"}, {"NO_COLOR", ""}});
  EXPECT_TRUE(contains(dumb, "ok       c: rays")) << dumb;
  EXPECT_FALSE(contains(dumb, "\x1b")) << dumb;
  EXPECT_FALSE(has_colour(run({"-o", "r"}).out)) << "in a file";

  std::ofstream(folder.path / "e.toml") << "unknown = 1\n";
  EXPECT_TRUE(contains(run_on_terminal(folder.path, {{"TERM", "xterm"}, {"NO_COLOR", ""}}),
                       "tlab:\x1b[0m e.toml:1"));
}

}  // namespace
}  // namespace laboratory

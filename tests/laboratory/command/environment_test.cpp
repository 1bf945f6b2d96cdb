// Results and drawings do not depend on the user's environment.
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// The bytes of all visible files except the report, which contains the command line.
std::map<std::string, std::string> results_of(const Sweep& sweep, const std::string& name) {
  auto files = sweep.visible(name);
  files.erase("report.html");
  return files;
}

TEST_F(Sweep, ResultsAndDrawingsDoNotDependOnTheEnvironment) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "no gnuplot";
  write_file(folder.path / "e.toml",
             "[image]\nwidth = 12\nheight = 8\n[sweep]\nobjects = [9]\nworkers = [1, 2]\n");
  fs::create_directory(folder.path / "inside");
  ASSERT_EQ(run_line(folder.path, "$TLAB run e.toml -o r > out 2>&1"), 0)
      << read_file(folder.path / "out");
  const auto expected = results_of(*this, "r");
  ASSERT_TRUE(expected.contains("plots/time_s.svg"));
  for (const char* line :
       {"LANG=pt_PT.UTF-8 $TLAB run e.toml", "LC_CTYPE=UTF-8 LC_NUMERIC=de_DE $TLAB run e.toml",
        "LC_ALL=no-such-locale LANGUAGE=de $TLAB run e.toml",
        "TZ=Mars/Phobos TMPDIR=/no-such-folder $TLAB run e.toml",
        "umask 077 && env -u HOME -u LANG $TLAB run e.toml",
        "GNUTERM=no-such GNUPLOT_DEFAULT_GDFONT=x GVBINDIR=/no FONTCONFIG_FILE=/no $TLAB run "
        "e.toml",
        "env -i PATH=\"$PATH\" $TLAB run e.toml", "cd inside && $TLAB run ../e.toml"}) {
    const auto output = (folder.path / "other").string();
    EXPECT_EQ(run_line(folder.path, "(" + std::string(line) + " -o " + output + ") > out 2>&1"), 0)
        << line << "\n"
        << read_file(folder.path / "out");
    EXPECT_TRUE(results_of(*this, "other") == expected) << line;
    fs::remove_all(output);
  }
}

// Neither Graphviz nor fontconfig depends on variables of the environment, and fontconfig does not
// write on the terminal.
TEST_F(Sweep, DrawingsOfGraphsDoNotDependOnTheEnvironment) {
  write_file(folder.path / "g.dot", "graph { a -- b; b -- c; c -- d }");
  for (const std::string drawing : {"ring:5 -o x.pdf", "g.dot -o x.svg"}) {
    const auto file = folder.path / drawing.substr(drawing.rfind(' ') + 1);
    std::string expected;
    for (const char* variable :
         {"LANG=C", "GVBINDIR=/no", "FONTCONFIG_FILE=/no", "FC_DEBUG=1023", "LC_ALL='\x1b[31mX'"}) {
      const auto line = fmt::format("env {} $TLAB topology {} > out 2>&1", variable, drawing);
      EXPECT_EQ(run_line(folder.path, line), 0) << line;
      EXPECT_EQ(read_file(folder.path / "out"), "") << line;
      if (expected.empty()) expected = read_file(file);
      EXPECT_TRUE(read_file(file) == expected) << line;
    }
  }
}

TEST_F(Sweep, ARemovedCurrentFolderIsNotNeeded) {
  const auto here = folder.path.string();
  ASSERT_EQ(run_line(folder.path, "($TLAB run e.toml -o r && $TLAB run e.toml -o q) > out 2>&1"),
            0);
  for (const std::string& arguments :
       {"run " + here + "/e.toml -o " + here + "/new", "report " + here + "/r",
        "merge " + here + "/r", "compare " + here + "/r " + here + "/q -o " + here + "/c.html",
        "render spheres:3 --size 4x4 -o " + here + "/x.png --stats " + here + "/x.json"}) {
    const auto line =
        "mkdir gone && cd gone && rmdir ../gone && $TLAB " + arguments + " > ../out 2>&1";
    EXPECT_EQ(run_line(folder.path, line), 0) << read_file(folder.path / "out");
  }
}

// A small stack is enlarged, also for threads. A program that may not enlarge it refuses to run.
TEST_F(Sweep, ASmallStackIsEnlargedOrRefused) {
  EXPECT_EQ(run_line(folder.path, "(ulimit -Ss 64; $TLAB run e.toml -o r) > out 2>&1"), 0)
      << read_file(folder.path / "out");
  EXPECT_EQ(run_line(folder.path, "(ulimit -Ss 64; $TLAB render spheres:9 --threads 2 -o x.png)"),
            0);
  EXPECT_EQ(run_line(folder.path, "(ulimit -s 64; $TLAB run e.toml -o r) > out 2> told"), 2);
  EXPECT_EQ(read_file(folder.path / "told"),
            "tlab: the stack: found a limit of 64 KiB, expected at least 1024 KiB (ulimit -s)\n");
}

// The message names the cause: too few file descriptors, or a current folder that was removed.
TEST_F(Sweep, ErrorsOfTheHostAreNamed) {
  EXPECT_EQ(run_line(folder.path, "(ulimit -n 9; $TLAB run e.toml -o r) > out 2> told"), 2);
  EXPECT_TRUE(contains(read_file(folder.path / "told"), "Too many open files"))
      << read_file(folder.path / "told");
  for (const char* arguments :
       {"run /e.toml -o r", "init x", "compare a b", "list experiments",
        "render spheres:5 -o x.png", "topology ring:4 -o x.svg", "report r", "merge r"}) {
    const auto line = "mkdir gone && cd gone && rmdir ../gone && $TLAB " + std::string(arguments) +
                      " > ../out 2> ../told";
    EXPECT_EQ(run_line(folder.path, line), 2) << arguments;
    const auto told = read_file(folder.path / "told");
    for (const char* foreign : {"filesystem error", "[", ".partial-", "std::"})
      EXPECT_FALSE(contains(told, foreign)) << arguments << ": " << told;
    EXPECT_TRUE(told.starts_with("tlab: ")) << arguments << ": " << told;
  }
}

}  // namespace
}  // namespace laboratory

// The promises in docs/manual/promises.md: readable messages, commands that can be repeated, errors
// for lack of memory, and the names of tests that the page refers to.
#include <regex>

#include "base/text.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// The suites and names of all tests in the source files.
std::set<std::string> find_tests() {
  std::set<std::string> tests;
  const std::regex declared(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
  for (const auto& entry : fs::recursive_directory_iterator(::test::in_sources("tests"))) {
    if (entry.path().extension() != ".cpp") continue;
    const auto text = read_file(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), declared), end; at != end; ++at)
      tests.insert(at->str(1) + "." + at->str(2));
  }
  return tests;
}

TEST(Promises, AreEachHeldByATest) {
  const auto page = read_file(::test::in_sources("docs/manual/promises.md"));
  const auto tests = find_tests();
  ASSERT_GT(tests.size(), 500u);
  const std::regex row(R"(\n\| (\d+) \|[^\n]*)"), name(R"(`(\w+\.\w+)`)");
  int rows = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at) {
    const auto line = at->str();
    EXPECT_EQ(at->str(1), std::to_string(++rows));
    int named = 0;
    for (std::sregex_iterator test(line.begin(), line.end(), name); test != end; ++test, ++named)
      EXPECT_TRUE(tests.contains(test->str(1))) << test->str(1);
    EXPECT_GT(named, 0) << line;
  }
  EXPECT_GE(rows, 14);
}

TEST_F(Sweep, MessagesAreInOurWords) {
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  fs::copy(folder.path / "r", folder.path / "q", fs::copy_options::recursive);
  const auto run_json = read_file(folder.path / "r/run.json");
  for (const std::string& damaged :
       {std::string("null"), std::string("{}"), std::string("[]"), std::string("{\"file\": 7}"),
        std::string(), run_json.substr(0, run_json.size() / 2), std::string("\0{}", 3)}) {
    write_file(folder.path / "r/run.json", damaged);
    for (const Arguments& arguments : {Arguments{"report", "r"}, {"compare", "r", "q"}}) {
      const auto told = tlab(folder.path, arguments);
      EXPECT_EQ(told.exit_code, 2) << told.err;
      EXPECT_TRUE(contains(told.err, "run.json: damaged: found ")) << told.err;
      for (const char* foreign : {"at()", "json.exception", "parse error", "key '", "type must"})
        EXPECT_FALSE(contains(told.err, foreign)) << told.err;
    }
  }
  // A zero byte in a name does not cut a message short.
  write_file(folder.path / "z.toml",
             "title = \"a\"\n[sweep]\nworkers = [1]\n[scene]\nsource = "
             "\"a\\u0000b.nff\"\n");
  const auto told = tlab(folder.path, {"run", "z.toml", "-o", "z"});
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_TRUE(contains(told.err, "a\\u0000b.nff")) << told.err;
}

// While a hidden folder is being filled, error messages name the final file.
TEST_F(Sweep, MessagesContainNoHiddenNames) {
  for (const char* arguments :
       {"init q", "run e.toml -o r", "topology ring:9 -o t.svg", "model m --new"})
    for (const char* blocks : {"0", "1", "2"}) {
      run_line(folder.path,
               "(ulimit -f " + std::string(blocks) + " && $TLAB " + arguments + ") > out 2> told");
      EXPECT_FALSE(contains(read_file(folder.path / "told"), ".partial-"))
          << arguments << ": " << read_file(folder.path / "told");
      run_line(folder.path, "rm -rf q r t.svg m.toml");
    }
}

// Starts a live run, ends it after a while, and repeats it with the command that it printed.
TEST_F(Sweep, TheCommandThatRepeatsASessionWorks) {
  write_file(folder.path / "a 'b'.toml", "[image]\nwidth = 12\nheight = 8\n[scene]\nobjects = 5\n");
  for (const char* speed : {"1e-9", "max"}) {
    const pid_t pid =
        start_tlab(folder.path, {"live", "a 'b'.toml", "--no-browser", "--speed", speed});
    const auto out = folder.path / ".out";
    for (int i = 0; i < 3000 && (!fs::exists(out) || read_file(out).empty()); ++i) usleep(10'000);
    kill(pid, SIGINT);
    const auto ended = wait_for_tlab(folder.path, pid);
    EXPECT_EQ(ended.exit_code, 130) << ended.err;
    const auto from = ended.out.find("The session: tlab ");
    ASSERT_NE(from, std::string::npos) << ended.out << ended.err;
    auto line = ended.out.substr(from + 18);
    line = line.substr(0, line.find('\n'));
    EXPECT_EQ(run_line(folder.path, "$TLAB " + line + " > out 2>&1"), 0)
        << line << "\n"
        << read_file(folder.path / "out");
  }
}

// Increases the limit on memory, beginning with the least with which the program starts.
TEST_F(Sweep, LackOfMemoryIsAnErrorAndLeavesNothingBehind) {
  const auto with_limit = [&](int kb, const char* arguments) {
    return run_line(folder.path,
                    "(ulimit -v " + std::to_string(kb) + " && $TLAB " + arguments + ") > out 2>&1");
  };
  int kb = 40'000;
  while (kb < 1'000'000 && with_limit(kb, "--version") != 0) kb += 4'000;
  if (kb >= 1'000'000) GTEST_SKIP() << "a sanitizer reserves address space";
  for (int i = 0; i < 12; ++i, kb += 5'000) {
    const int code = with_limit(kb, "run e.toml -o r --jobs 2");
    const auto told = read_file(folder.path / "out");
    EXPECT_TRUE(code == 0 || code == 2) << kb << " KB: " << code << "\n" << told;
    EXPECT_FALSE(contains(told, "std::bad_alloc")) << told;
    fs::remove_all(folder.path / "r");
    with_limit(kb, "render spheres:20 -o x.png --size 8x8 --threads 8");
    EXPECT_FALSE(contains(read_file(folder.path / "out"), "ulimit -u")) << kb << " KB";
    fs::remove(folder.path / "x.png");
    EXPECT_EQ(folder.names(), (Arguments{"e.toml", "out"})) << kb << " KB";
  }
}

TEST(Promises, LongFilmsAreAnnounced) {
  const TemporaryFolder folder;
  const auto told = tlab(folder.path, {"render", "spheres:50", "-o", "x.png", "--size", "300x300",
                                       "--frames", "0-99999"});
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_TRUE(contains(told.err, "--frames: 100000 frames take about ")) << told.err;
  EXPECT_TRUE(contains(told.err, "--yes")) << told.err;
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace laboratory

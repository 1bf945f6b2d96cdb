// Output that only terminals get: progress bars, and long texts in a pager.
#include "tests/laboratory/support/terminal.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

TEST(Terminal, TheBarIsShownToItsEnd) {
  const auto text = on_terminal([] {
    Progress bar("drawing");
    bar.show(1, 2);
    bar.show(2, 2);  // the last value is always shown
  });
  EXPECT_TRUE(contains(text, "drawing [===============               ] 1/2, about ")) << text;
  const auto end = text.find("drawing [==============================] 2/2");
  ASSERT_NE(end, std::string::npos) << text;
  EXPECT_FALSE(contains(text.substr(end), "left")) << text;
}

TEST(Terminal, ARenderingShowsHowFarItIs) {
  const TemporaryFolder folder;
  const auto text = on_terminal([&] {
    std::filesystem::current_path(folder.path);
    std::string words[] = {"tlab", "render", "spheres:5", "-o", "i.png", "--size", "6x4"};
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    run_tlab(static_cast<int>(argv.size()), argv.data());
  });
  EXPECT_TRUE(contains(text, "rendering [==============================] ")) << text;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"i.png"});
}

// Control characters in titles, names and arguments do not reach the terminal.
TEST(Terminal, NothingFromAFileReachesItUnescaped) {
  const TemporaryFolder folder;
  const std::string hostile = "a\x1b]0;owned\x07\x1b[31mb\xc2\x9b";
  write_file(
      folder.path / (hostile + ".toml"),
      "title = \"t\\u001b]0;owned\\u0007\\u001b[31m\\u009b\"\n[image]\nwidth = 12\nheight = "
      "8\n[sweep]\nobjects = [5]\n[[check]]\nname = \"c\\u001b[31m\"\nof = \"rays\"\nat_least "
      "= 1e9\n");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", hostile + ".toml"},
        {"init", hostile},
        {"list", "experiments", "."},
        {"render", hostile, "-o", "x.png"},
        {"model", hostile},
        {"topology", hostile},
        {hostile},
        {"help", hostile}}) {
    auto text = on_terminal([&] {
      std::filesystem::current_path(folder.path);
      setenv("NO_COLOR", "1", 1);
      setenv("PAGER", "cat", 1);
      auto words = arguments;
      words.insert(words.begin(), "tlab");
      std::vector<char*> argv;
      for (auto& word : words) argv.push_back(word.data());
      run_tlab(static_cast<int>(argv.size()), argv.data());
    });
    // the only sequence of tlab itself: it erases the line of the progress bar
    const std::string own = "\r\x1b[K";
    for (std::size_t at; (at = text.find(own)) != text.npos;) text.erase(at, own.size());
    EXPECT_FALSE(text.empty());
    for (const char* control : {"\x1b", "\x07", "\xc2\x9b"})
      EXPECT_FALSE(contains(text, control)) << arguments[0] << ": " << text;
  }
}

// The pager's text follows the earlier output. If the pager fails, the text is printed without it.
TEST(Terminal, APagerShowsTheTextInItsTurn) {
  for (const char* pager : {"cat", "exit 1"}) {
    const auto text = on_terminal([&] {
      setenv("PAGER", pager, 1);
      std::fputs("first, ", stdout);
      print_paged("then the text\n");
    });
    EXPECT_EQ(text, "first, then the text\r\n") << pager;
  }
}

}  // namespace
}  // namespace laboratory

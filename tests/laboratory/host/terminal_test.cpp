// Output for terminals only: progress bars, and long texts in a pager.
#include "tests/laboratory/support/terminal.hpp"
#include "experiments/laboratory/host/pager.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

TEST(Terminal, TheBarIsShownToItsEnd) {
  const auto text = on_terminal([] {
    Progress bar("drawing");
    bar.show(1, 2);
    bar.show(2, 2);  // the last value is shown at once
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

// Earlier output precedes the pager's text. Without a pager the text is still shown.
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

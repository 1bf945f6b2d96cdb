// What messages repeat of an input, and offer in the place of unknown names.
#include "base/message.hpp"

#include <gtest/gtest.h>

namespace base {
namespace {

TEST(Message, ControlsAndBrokenCharactersAreEscaped) {
  EXPECT_EQ(make_readable("a\x1b[2Jb\x7f\r\tc\nd"), "a\\x1b[2Jb\\x7f\\x0d\\x09c\nd");
  EXPECT_EQ(make_readable("ä € 𝄞"), "ä € 𝄞");
  EXPECT_EQ(make_readable("\xff\xc3(\xe2\x82"), "\\xff\\xc3(\\xe2\\x82");
  EXPECT_EQ(make_readable("\xc0\xaf\xed\xa0\x80\xc2\x9b"), "\\xc0\\xaf\\xed\\xa0\\x80\\xc2\\x9b")
      << "overlong, a surrogate, a control";
}

TEST(Message, TheMiddleOfALongOneIsLeftOut) {
  EXPECT_EQ(make_readable(std::string(2000, 'x')), std::string(2000, 'x'));
  const auto cut = make_readable("begin " + std::string(1'000'000, 'x') + " end");
  EXPECT_LT(cut.size(), 2000u);
  EXPECT_TRUE(cut.starts_with("begin xxx") && cut.ends_with("xxx end")) << cut;
  EXPECT_NE(cut.find(" ... (998210 bytes) ... "), std::string::npos) << cut;
  for (int shift = 0; shift < 4; ++shift) {
    std::string text(shift, 'x');
    while (text.size() < 5000) text += "€";
    EXPECT_EQ(make_readable(text).find("\\x"), std::string::npos) << "no character is cut";
  }
}

const std::vector<std::string> COMMANDS = {"topology", "render", "run", "verify"};

TEST(Suggest, SimilarNamesAreOffered) {
  EXPECT_EQ(suggest("runn", COMMANDS), ", the nearest is \"run\"");
  EXPECT_EQ(suggest("topolgy", COMMANDS, "try"), ", try \"topology\"");
  EXPECT_EQ(suggest("cell", {"time", "min_cell"}), ", the nearest is \"min_cell\"");
  EXPECT_EQ(did_you_mean("verfy", COMMANDS), " (did you mean \"verify\"?)");
}

TEST(Suggest, OthersAreNot) {
  EXPECT_EQ(suggest("list", COMMANDS), ", expected one of topology, render, run, verify");
  EXPECT_EQ(did_you_mean("list", COMMANDS), "");
  EXPECT_EQ(did_you_mean(std::string(1'000'000, 'r'), COMMANDS), "");
  EXPECT_EQ(suggest("list", {}), "");
}

}  // namespace
}  // namespace base

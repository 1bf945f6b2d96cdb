// Tests error messages: escapes in quoted input, and suggestions for unknown names.
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
  EXPECT_EQ(make_readable("\u202ea\u2066"), "\\xe2\\x80\\xaea\\xe2\\x81\\xa6") << "directions";
  EXPECT_EQ(make_readable("\u2029\u202f\u2065\u206a"), "\u2029\u202f\u2065\u206a");
}

TEST(Message, TheMiddleOfALongLineIsLeftOut) {
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

TEST(Message, AnyNumberOfLinesIsWhole) {
  std::string lines = "deadlock:\n";
  for (int i = 0; i < 1000; ++i) lines += "  one waits for another\n";
  EXPECT_EQ(make_readable(lines + "the cycle"), lines + "the cycle");
  const auto cut = make_readable(lines + std::string(3000, 'x') + "\n\nend\n");
  EXPECT_TRUE(cut.starts_with(lines + "xxx") && cut.ends_with("xxx\n\nend\n")) << cut;
  EXPECT_NE(cut.find(" ... (1200 bytes) ... "), std::string::npos) << cut;
}

const std::vector<std::string> COMMANDS = {"topology", "render", "run", "verify"};

TEST(Suggest, SimilarNamesAreOffered) {
  EXPECT_EQ(suggest("runn", COMMANDS), ", the nearest is \"run\"");
  EXPECT_EQ(suggest("rnu", COMMANDS), ", the nearest is \"run\"");
  EXPECT_EQ(suggest("topolgy", COMMANDS, "try"), ", try \"topology\"");
  EXPECT_EQ(suggest("cell", {"time", "min_cell"}), ", the nearest is \"min_cell\"");
  EXPECT_EQ(did_you_mean("verfy", COMMANDS), " (did you mean \"verify\"?)");
}

TEST(Suggest, ASwapOfNeighboursIsOneEdit) {
  EXPECT_EQ(count_edits("rnu", "run"), 1u);
  EXPECT_EQ(count_edits("vreiyf", "verify"), 2u);
  EXPECT_EQ(count_edits("ca", "abc"), 3u) << "no letter is edited twice";
  EXPECT_EQ(count_edits("", "ab"), 2u);
  EXPECT_EQ(count_edits("ab", ""), 2u);
  EXPECT_EQ(count_edits("kitten", "sitting"), 3u);
}

TEST(Suggest, ThisManyLettersMayBeOthers) {
  EXPECT_EQ(did_you_mean("abyy", {"abcd"}), " (did you mean \"abcd\"?)");
  EXPECT_EQ(did_you_mean("xxcd", {"abyd"}), "");
}

TEST(Suggest, OthersAreNot) {
  EXPECT_EQ(suggest("list", COMMANDS), ", expected one of topology, render, run, verify");
  EXPECT_EQ(did_you_mean("list", COMMANDS), "");
  EXPECT_EQ(did_you_mean(std::string(1'000'000, 'r'), COMMANDS), "");
  EXPECT_EQ(suggest("list", {}), "");
}

TEST(Suggest, NamesStayOnOneLine) {
  EXPECT_EQ(suggest("latency_s", {"latency\n_s"}), ", the nearest is \"latency _s\"");
  EXPECT_EQ(suggest("rays", {"a\nb", "c"}), ", expected one of a b, c");
  EXPECT_EQ(did_you_mean("run", {"run\n"}), " (did you mean \"run \"?)");
}

}  // namespace
}  // namespace base

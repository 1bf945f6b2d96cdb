// What people read of messages that repeat an input.
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

}  // namespace
}  // namespace base

#include "base/text.hpp"

#include <gtest/gtest.h>

namespace base {
namespace {

TEST(Text, TrimsAndSplits) {
  using Parts = std::vector<std::string_view>;
  EXPECT_EQ(trim(" \ta b\r"), "a b");
  EXPECT_EQ(trim(" \t "), "");
  EXPECT_EQ(split("a, b ,,c", ','), (Parts{"a", "b", "", "c"}));
  EXPECT_EQ(split("", ','), Parts{""});
}

TEST(Text, NumbersAreWholeWords) {
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<double>("1e3"), 1000.0);
  for (const auto* word : {"", " 1", "1 ", "1x", "+1", "99999999999"})
    EXPECT_EQ(parse_number<int>(word), std::nullopt) << word;
}

TEST(Text, NearestNameTakesTheFewestEdits) {
  EXPECT_EQ(nearest_name("rnig", {"line", "ring", "tree"}), "ring");
  EXPECT_EQ(nearest_name("", {"ab", "c", "d"}), "c");
}

TEST(Text, QuotesArePrintableAndShort) {
  EXPECT_EQ(quote("a\nb\xff"), "'a\\x0ab\\xff'");
  EXPECT_EQ(quote(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, ControlCharactersAreReplaced) {
  EXPECT_EQ(blank_controls("a\x1b[2Jb\x7f\n"), "a [2Jb  ");
  EXPECT_EQ(blank_controls("ä\t", '?'), "ä?");
  EXPECT_EQ(escape_xml("<&>\"'\x01\t\x7f"), "&lt;&amp;&gt;&quot;&#39;\xef\xbf\xbd\t\x7f");
}

TEST(Text, Utf8IsWhatTheStandardSays) {
  for (const auto* text : {"", "a\n", "\x7f", "\xc2\x80", "\xc3\xa4", "\xed\x9f\xbf",
                           "\xee\x80\x80", "\xf4\x8f\xbf\xbf", "\xf0\x90\x80\x80"})
    EXPECT_TRUE(is_utf8(text)) << quote(text);
  // Invalid UTF-8: stray or missing continuation bytes, overlong forms, surrogates, code points
  // above U+10FFFF.
  for (const auto* text :
       {"\x80", "\xff", "\xc3", "\xc3(", "\xe2\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf",
        "\xf0\x8f\xbf\xbf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(text)) << quote(text);
    EXPECT_FALSE(is_utf8(std::string("a") + text)) << quote(text);
  }
  EXPECT_EQ(measure_utf8("\xe2\x82\xac)"), 3u);
}

TEST(Text, FirstCommentIsASentence) {
  EXPECT_EQ(first_comment("# A room. It has a window.\nquad"), "A room");
  EXPECT_EQ(first_comment("// One\n// and two.\nx"), "One and two");
  EXPECT_EQ(first_comment("# After R. L. Cook. Then"), "After R. L. Cook");
  EXPECT_EQ(first_comment("# Built in the USA. Then"), "Built in the USA");
  EXPECT_EQ(first_comment("v\n# late"), "");
  EXPECT_EQ(first_comment(""), "");
}

TEST(Text, LowerCaseIsOfAsciiLettersOnly) {
  EXPECT_EQ(to_lower("PART.Stl 9_[`{\xC3\x84"), "part.stl 9_[`{\xC3\x84");
}

}  // namespace
}  // namespace base

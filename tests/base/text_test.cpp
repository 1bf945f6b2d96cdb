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

}  // namespace
}  // namespace base

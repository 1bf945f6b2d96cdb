// Tests reading and writing of TOML files, and the limit on the number of parts in a key.
#include "base/toml.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "base/random.hpp"
#include "tests/support/files.hpp"

namespace base {
namespace {

std::string repeat(int times, const std::string& part) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

std::string refusal_of(const std::string& text) {
  return test::message_of<BadInput>([&] { parse_toml(text, "e.toml"); });
}

TEST(Toml, KeysHaveALimitedNumberOfParts) {
  const std::string expected = "e.toml:2: found a key of more than 16 parts, expected at most 16";
  for (const int parts : {MAX_KEY_PARTS + 1, 60'000})
    for (const char* part : {"a", "\"a.b\"", "'#' ", " a-b_c\t"}) {
      const auto key = repeat(parts - 1, part + std::string(".")) + part;
      for (const auto& text :
           {key + " = 1", "[" + key + "]", "[[" + key + "]]", "x = { y = 1, " + key + " = 1 }",
            "x = { y = \"\"\"z\"\"\"\", " + key + " = 1 }",
            "x = { y = \"\"\"z\"\"\"\"\", " + key + " = 1 }",
            "x = { y = '''z'''', " + key + " = 1 }"})
        EXPECT_EQ(refusal_of("\n" + text), expected) << text.substr(0, 100);
    }
}

TEST(Toml, PointsElsewhereAreNoPartsOfAKey) {
  const auto points = repeat(100, ".");
  EXPECT_EQ(refusal_of(repeat(MAX_KEY_PARTS - 1, "a.") + "a = 1"), "");
  for (const auto& text :
       {"a = \"\\\"" + points + "\"", "a = '" + points + "'", "a = 1 # " + points,
        "a = \"\"\"\n\"\"" + points + "\\\"\"\"\"", "a = '''\n" + points + "'''",
        "a = [\"\"\"\"\"\"\"\", \"" + points + "\"]", "a = [\"\", \"" + points + "\"]",
        "a = [" + repeat(100, "1.5, ") + "]", std::string("[a]\nb = 1.5")}) {
    EXPECT_EQ(refusal_of(text), "") << text;
  }
}

// For a long value of --set, the place in error messages is as long as the value. Formatting the
// place at each character would take quadratic time.
TEST(Toml, ALongTextWithALongPlaceIsRead) {
  const auto text = "a = [" + repeat(200'000, "1,") + "]";
  EXPECT_EQ(parse_toml(text, text)["a"].as_array()->size(), 200'000u);
}

TEST(Toml, TheDepthOfValuesIsLimited) {
  for (const auto& [begin, end] : {std::pair("[", "]"), std::pair("{a = ", "}")})
    EXPECT_EQ(refusal_of("\na = " + repeat(1000, begin) + repeat(1000, end)),
              "e.toml:2: found arrays or tables in more than 256 others, expected at most 256");
}

// A key of MAX_KEY_PARTS parts with deeply nested values. toml++ limits the nesting of values to
// 256.
TEST(Toml, TheDeepestFileIsReadAndDestroyed) {
  const auto key = repeat(MAX_KEY_PARTS - 1, "a.") + "a";
  EXPECT_EQ(refusal_of("[" + key + "]\n" + key + " = " + repeat(250, "{" + key + " = ") + "1" +
                       repeat(250, "}")),
            "");
}

TEST(Toml, SomeKeysAreRefused) {
  for (const auto* key : {"\"a'b\"", "\"'\"", "\"a\\tb\"", "\"a\\n\""})
    for (const auto& text : {key + std::string(" = 1"), fmt::format("a = [{{{} = 1}}]", key),
                             fmt::format("[a.{}]", key)})
      EXPECT_EQ(refusal_of("\n" + text),
                "e.toml:2: found a key with a quote, a tab or a line end, expected none in it")
          << text;
}

TEST(Toml, WhatTheLibraryDoesNotStandIsRefused) {
  for (const auto* text :
       {"a = 1\xc3\xa9", "\xc3\xa9 = 1", "a = 1 \xef\xbb\xbf", "[a\xe2\x80\xa8]"})
    EXPECT_EQ(refusal_of(std::string("\n") + text),
              "e.toml:2: found a letter beyond ASCII, expected it in a text or a comment")
        << text;
  EXPECT_EQ(refusal_of("a = [1,\n-9223372036854775808]"),
            "e.toml:2: found -9223372036854775808, expected a larger number");
  EXPECT_EQ(refusal_of("\xef\xbb\xbf# \xc3\xa9\n\"\xc3\xa9\" = '\xc3\xa9' # \xe2\x80\xa8\n"
                       "b = \"\"\"\n\xc3\xa9\"\"\"\nc = -9223372036854775807"),
            "");
}

TEST(Toml, WholeNumbersAreWrittenInDecimal) {
  const auto numbers = parse_toml("a = 0.1\nb = 1.0\nc = 1e300\nd = -0.0", "e.toml");
  EXPECT_EQ(to_toml(*numbers.get("a")), "0.1");
  EXPECT_EQ(to_toml(*numbers.get("b")), "1.0");
  EXPECT_EQ(to_toml(*numbers.get("c")), "1e+300");
  EXPECT_EQ(to_toml(*numbers.get("d")), "-0.0");
  EXPECT_EQ(to_toml(parse_toml("a = [0x10, 0o10, 0b10, 10]", "e.toml")), "a = [ 16, 8, 2, 10 ]");
}

TEST(Toml, WhatIsWrittenIsReadAgainAsTheSame) {
  constexpr const char* PARTS[] = {"\n",       "\r",           "\t",  " ", "'", "'''",
                                   "\"",       "\"\"\"",       "\\",  "a", "#", "=",
                                   "\xc3\xa9", "\xe2\x80\xa8", "\x7f"};
  Random random(1);
  const auto make_text = [&] {
    std::string text;
    for (int parts = random.below(5); parts > 0; --parts)
      text += PARTS[random.below(static_cast<int>(std::size(PARTS)))];
    return text;
  };
  const auto make_key = [&] {
    std::string key = make_text();
    std::erase_if(key, [](char c) { return c == '\'' || c == '\t' || c == '\n'; });
    return key;
  };
  for (int i = 0; i < 2000; ++i) {
    const toml::table table{{make_key(), toml::array{make_text(), 1}},
                            {"b", toml::table{{make_key(), make_text()}}},
                            {"c", toml::array{toml::table{{make_key(), 0.1}}, make_text()}}};
    const auto written = to_toml(table);
    SCOPED_TRACE(written);
    EXPECT_EQ(refusal_of(written), "");
    if (HasFailure()) return;
    EXPECT_TRUE(parse_toml(written, "again.toml") == table);
  }
}

}  // namespace
}  // namespace base

#include "base/csv.hpp"

#include <gtest/gtest.h>
#include "base/errors.hpp"

#include "tests/support/files.hpp"

namespace base {
namespace {

using Texts = std::vector<std::string>;

Texts texts_of(const std::vector<CsvCell>& record) {
  Texts texts;
  for (const auto& cell : record) texts.push_back(cell.text);
  return texts;
}

TEST(Csv, QuotedCellsComeBack) {
  const Texts awkward{"",   " ",    "a,b", "\"",      "\"\"",  "a\nb",  "a\r\nb",
                      "\r", "#not", " x",  "trail\t", "plain", "größe", "it's"};
  std::vector<std::string> cells;
  for (const auto& text : awkward) cells.push_back(quote_csv(text));
  const auto text = join_csv(cells) + join_csv(cells);
  CsvReader reader(text, "x.csv");
  EXPECT_EQ(texts_of(reader.take()), awkward);
  EXPECT_EQ(texts_of(reader.take()), awkward);
  EXPECT_EQ(reader.line(), 4);  // two cells of the first record contain line ends
  EXPECT_TRUE(reader.take().empty());
}

TEST(Csv, QuotesOnlyWhatNeedsThem) {
  EXPECT_EQ(quote_csv("a b's-1.5"), "a b's-1.5");
  EXPECT_EQ(quote_csv("a,\"b\""), "\"a,\"\"b\"\"\"");
  // quote_csv also quotes \r. CsvReader does not treat a lone \r as a line end, but many programs
  // do.
  EXPECT_EQ(quote_csv("a\rb"), "\"a\rb\"");
  EXPECT_EQ(quote_csv("a\nb"), "\"a\nb\"");
  EXPECT_EQ(join_csv({"a", "", "b"}), "a,,b\n");
}

TEST(Csv, ACellMayBeginLikeAByteOrderMark) {
  const std::string cell = "\xef\xbb\xbfx";
  const auto text = join_csv({quote_csv(cell)});
  EXPECT_EQ(texts_of(CsvReader(text, "x.csv").take()), Texts{cell});
}

TEST(Csv, CommentsBlankLinesAndEmptyCells) {
  CsvReader reader("\xef\xbb\xbf# first\n\n a , b\r\n#,\n1,\n\"\"", "x.csv");
  EXPECT_EQ(reader.take_header(), (Texts{"a", "b"}));
  EXPECT_EQ(reader.line(), 3);
  EXPECT_EQ(texts_of(reader.take()), (Texts{"1", ""}));
  const auto quoted = reader.take();
  EXPECT_EQ(texts_of(quoted), Texts{""});
  EXPECT_FALSE(is_blank(quoted));
  EXPECT_TRUE(reader.take().empty());
}

TEST(Csv, MistakesAreNamedWithTheirLine) {
  const auto told = [](const char* text) {
    return test::message_of<BadInput>([&] {
      CsvReader reader(text, "x.csv");
      while (!reader.take().empty()) continue;
    });
  };
  EXPECT_EQ(told("a\n\"b\nc"), "x.csv:2: a quote opened here is never closed");
  EXPECT_EQ(told("\"b\"c"),
            "x.csv:1: 'c' after a closing quote, expected a comma or the end of the line");
  EXPECT_TRUE(told("a\"b").starts_with("x.csv:1: a quote inside the cell a\"b"));
}

}  // namespace
}  // namespace base

#include "experiments/laboratory/report/report.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/errors.hpp"
#include "experiments/laboratory/report/embed.hpp"
#include "renderer/image/animation.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {
namespace {

using std::string_literals::operator""s;

// A PNG file with one black pixel.
const std::string PNG =
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\0\0\0\0\x3a\x7e\x9b\x55\0\0\0\nIDAT\x78\x9c"
    "\x63\x60\0\0\0\2\0\1\x48\xaf\xa4\x71\0\0\0\0IEND\xae\x42\x60\x82"s;

constexpr const char* SVG =
    "<?xml version=\"1.0\"?><!-- x -->\n<svg viewBox=\"0 0 1 1\" "
    "xmlns=\"http://www.w3.org/2000/svg\"><title>Gnuplot</title><desc>Produced by</desc>"
    "<g id=\"a\"><path id='b'/><use xlink:href='#b' id='c' fill=\"url(#a)\"/></g></svg>";

Report make_example(const TemporaryFolder& folder) {
  Report report;
  report.title = "Farm <script>alert('1')</script>";
  report.question = "Is \"a\" < b & c?";
  report.table = {.columns = {"topology", "workers", "time_s", "hidden"}, .axes = 2, .rows = {}};
  for (int w = 1; w <= 30; ++w)
    report.table.rows.push_back({"<b>" + std::to_string(w), std::int64_t{w}, 100.0 / w, "secret"});
  report.shown_columns = {"topology", "workers", "time_s"};
  report.facts = {{"Machine", "T805 <25>"}};
  report.plots = {{"T: y over x", SVG}, {"U \"of\" V", SVG}};
  write_file(folder.path / "image.png", PNG);
  report.images = {{"The <image>", folder.path / "image.png"}};
  report.settings = "title = \"<script>\"\n";
  report.command = "tlab run a.toml --set 'x=\"y\"'";
  report.model = {{"clock_mhz", "25", "MHz", "datasheet", "<p. 1>"}};
  report.notes = {"see https://example.org/ & think"};
  return report;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

// The page without its scripts and the data for them.
std::string without_scripts(const std::string& html) {
  auto text = html;
  for (auto at = text.find("<script"); at != std::string::npos; at = text.find("<script"))
    text.erase(at, text.find("</script>", at) + 9 - at);
  return text;
}

TEST(ExperimentsReport, FiguresCarryTheirTablesAndDrawingsTheirCaptions) {
  const TemporaryFolder folder;
  auto report = make_example(folder);
  report.findings = {"a < b"};
  const Table numbers{.columns = {"series", "value"}, .axes = 1, .rows = {{"s", 4.5}}};
  report.plots[0].numbers = {"", {"left <out>"}, {numbers, Table{}}};
  report.answers = {{"Which is best?", {}, {numbers}}, {"Nothing", {}, {Table{}}}};
  report.networks = {{"tree:7 & load", SVG}, {"ring:3", SVG}};
  const auto html = make_report(report);
  std::size_t at = 0;
  for (const char* part :
       {"<h2>What was found</h2>", "<li>a &lt; b</li>", "<h2>Machine</h2>", "<h2>Plots</h2>",
        "id=\"plot1-a\"", "left &lt;out&gt;", "4.5", "id=\"plot2-a\"", "<h2>Answers</h2>",
        "<h3>Which is best?</h3>", "<h2>Results</h2>", "<h2>Load of the network</h2>",
        "id=\"network1-a\"", "tree:7 &amp; load", "id=\"network2-a\"", "<h2>Images</h2>",
        "<h2>Settings</h2>", "<h2>How to reproduce</h2>", "<h2>Machine model</h2>"}) {
    const auto found = html.find(part, at);
    ASSERT_NE(found, std::string::npos) << part;
    at = found;
  }
  EXPECT_EQ(html.find("<h3>Nothing"), std::string::npos);
  EXPECT_EQ(count(html, "<details open>"), 1u);
}

TEST(ExperimentsReport, LoadsAreATableOfTheirOwn) {
  const TemporaryFolder folder;
  auto report = make_example(folder);
  EXPECT_EQ(make_report(report).find("Loads"), std::string::npos);
  report.load_columns = {report.table.columns[0], report.table.columns.back()};
  const auto html = make_report(report);
  const auto results = html.find("<h2>Results</h2>");
  EXPECT_GT(html.find("<details><summary>Loads</summary>\n<div"), results);
  EXPECT_LT(html.find("</details>", results), html.find("All ", results));
}

TEST(ExperimentsReport, LongTablesAreCutAndSaySo) {
  Report report;
  report.table = {.columns = {"processor", "value"}, .axes = 1, .rows = {}};
  for (int row = 0; row < 1000; ++row) report.table.rows.push_back({double(row), 1.5});
  report.shown_columns = report.table.columns;
  const auto whole = make_report(report);
  EXPECT_EQ(whole.find("The table has the first"), std::string::npos);
  for (int row = 0; row < 64536; ++row) report.table.rows.push_back({double(row), 1.5});
  const auto cut = make_report(report);
  EXPECT_NE(cut.find("The table has the first 1000 of 65536 rows; all are in the CSV files."),
            std::string::npos);
  EXPECT_EQ(count(cut, "<tr"), count(whole, "<tr"));
}

TEST(ExperimentsReport, NeedsNothingFromOutside) {
  const TemporaryFolder folder;
  const auto html = make_report(make_example(folder));
  const std::regex reference(R"((src|href)\s*=\s*["']([^"']{0,12}))", std::regex::icase);
  std::size_t references = 0;
  for (std::sregex_iterator it(html.begin(), html.end(), reference), end; it != end; ++it) {
    const auto target = (*it)[2].str();
    EXPECT_TRUE(target.starts_with("data:") || target.starts_with("#")) << it->str();
    ++references;
  }
  EXPECT_EQ(references, 4u);  // the image, the CSV file, and one reference in each of two plots
  EXPECT_EQ(count(html, "@import"), 0u);
  EXPECT_EQ(count(html, "<link"), 0u);
}

TEST(ExperimentsReport, EscapesEveryText) {
  const TemporaryFolder folder;
  const auto html = make_report(make_example(folder));
  for (const auto* tag : {"<b>", "<25>", "<image>", "<p. 1>"})
    EXPECT_EQ(count(html, tag), 0u) << tag;
  EXPECT_EQ(count(html, "<script"), 2u);
  EXPECT_EQ(count(html, "</script"), 2u);
  // the text is in the title, the heading and the experiment
  EXPECT_EQ(count(html, "&lt;script&gt;"), 3u);
  Report report;
  report.title = "{{<&>}}\"'\x01";
  EXPECT_EQ(count(make_report(report), "<h1>{{&lt;&amp;&gt;}}&quot;&#39;\xef\xbf\xbd</h1>"), 1u);
}

TEST(ExperimentsReport, HoldsEveryRowAndTheShownColumns) {
  const TemporaryFolder folder;
  const auto report = make_example(folder);
  const auto html = make_report(report);
  const auto times = format_column(report.table, 2);
  for (std::size_t i = 0; i < report.table.rows.size(); ++i)
    EXPECT_EQ(count(html, "<th scope=\"row\">&lt;b&gt;" + std::to_string(i + 1) +
                              "</th>\n<th scope=\"row\" class=\"number\">" + std::to_string(i + 1) +
                              "</th>\n<td class=\"number\">" + times[i] + "</td>\n</tr>"),
              1u);
  EXPECT_EQ(count(html, "secret"), 0u);
  EXPECT_EQ(count(html, to_base64(to_csv(report.table))), 1u);
  EXPECT_EQ(count(html, to_base64(PNG)), 1u);
  EXPECT_EQ(html, make_report(report));
}

TEST(ExperimentsReport, IdentifiersAreUnique) {
  const TemporaryFolder folder;
  const auto html = make_report(make_example(folder));
  std::map<std::string, int> ids;
  const std::regex id(R"( id=["']([^"']*))");
  for (std::sregex_iterator it(html.begin(), html.end(), id), end; it != end; ++it)
    EXPECT_EQ(++ids[(*it)[1]], 1) << it->str();
  EXPECT_EQ(ids.size(), 6u);
  EXPECT_EQ(count(html, "href='#plot2-b'"), 1u);
  EXPECT_EQ(count(html, "url(#plot2-a)"), 1u);
  EXPECT_EQ(count(html, "Gnuplot"), 0u);
}

TEST(ExperimentsReport, TagsAreBalanced) {
  const TemporaryFolder folder;
  const auto html = without_scripts(make_report(make_example(folder)));
  std::vector<std::string> open;
  int closed = 0;
  const std::regex tag(R"(<(/?)([a-z0-9]+)[^>]*?(/?)>)");
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const auto name = (*it)[2].str();
    if (name == "meta" || name == "img" || (*it)[3] == "/") continue;
    if ((*it)[1] != "/") {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << it->str();
    ASSERT_EQ(open.back(), name);
    open.pop_back();
    ++closed;
  }
  EXPECT_TRUE(open.empty());
  EXPECT_GT(closed, 50);
}

// The JSON data that the script of the page reads.
nlohmann::json read_data(const std::string& html) {
  const std::string begin = "<script type=\"application/json\"";
  const auto from = html.find('>', html.find(begin)) + 1;
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(ExperimentsReport, ThePageKnowsItsPlotsAndPoints) {
  const TemporaryFolder folder;
  auto report = make_example(folder);
  report.plots[1].data = R"({"title":"</script><!--"})";
  report.points = {{"workers = 1", "done", {{"coordination", 0.98, "</script>\"\xff"}}},
                   {"workers = 2", "done", {}}};
  const auto html = make_report(report);
  const auto data = read_data(html);
  EXPECT_TRUE(data["plots"][0].is_null());
  EXPECT_EQ(data["plots"][1]["title"], "</script><!--");
  ASSERT_EQ(data["points"].size(), 2u);
  EXPECT_EQ(data["points"][0]["why"], "Limited by coordination 0.98: </script>\"\xef\xbf\xbd.");
  EXPECT_EQ(data["points"][0]["loads"][0][1], 0.98);
  EXPECT_EQ(data["points"][1]["why"], "");
  EXPECT_EQ(count(html, "</script"), 3u);
  EXPECT_EQ(count(html, "<!--"), 0u);
  EXPECT_EQ(count(html, "<tr data-point="), 2u) << "rows of points that are not told";
}

TEST(ExperimentsReport, OnlyPagesWithChartsContainTheirLibrary) {
  const TemporaryFolder folder;
  auto report = make_example(folder);
  const std::string copyright = "github.com/danvk/dygraphs";
  EXPECT_EQ(count(make_report(report), copyright), 0u);
  report.plots[0].data = "{}";
  EXPECT_EQ(count(make_report(report), copyright), 1u);
}

// The page allows only scripts that carry its nonce. The author of a text in the results cannot
// know the nonce.
TEST(ExperimentsReport, NoOtherScriptRuns) {
  const TemporaryFolder folder;
  auto report = make_example(folder);
  report.plots[0].data = "{}";
  const std::regex policy("script-src 'nonce-([0-9a-f]{32})'");
  std::smatch first, second;
  const auto html = make_report(report);
  ASSERT_TRUE(std::regex_search(html, first, policy));
  EXPECT_EQ(count(html, "nonce=\"" + first[1].str() + "\""), 3u);
  report.title += " ";
  const auto other = make_report(report);
  ASSERT_TRUE(std::regex_search(other, second, policy));
  EXPECT_NE(first[1], second[1]);
}

TEST(ExperimentsReport, LeavesOutWhatIsEmpty) {
  Report report;
  report.title = "Nothing";
  EXPECT_EQ(count(make_report(report), "<section>"), 0u);
}

TEST(ExperimentsReport, BadFilesAreNamed) {
  const TemporaryFolder folder;
  auto report = make_example(folder);
  write_file(folder.path / "image.png", "GIF89a");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { make_report(report); }),
            (folder.path / "image.png").string() + ": 6 bytes that are no PNG image, expected one");
  report.images[0].file = folder.path / "none.png";
  EXPECT_NE(message_of<base::BadInput>([&] { make_report(report); }).find("none.png"),
            std::string::npos);
  report.images.clear();
  report.plots[1].svg = "";
  EXPECT_NE(message_of<std::invalid_argument>([&] { make_report(report); }).find("no <svg>"),
            std::string::npos);
}

TEST(ExperimentsReport, AWebpHasTheSizeOfItsPicturesWhetherItMovesOrNot) {
  constexpr unsigned WIDTH = 300, HEIGHT = 7;
  renderer::Frame frame;
  frame.bitmap = {WIDTH, HEIGHT, std::vector<std::uint8_t>(3 * WIDTH * HEIGHT)};
  std::vector<renderer::Frame> frames{frame};
  frame.bitmap.rgb8[0] = 255;
  for (const char* kind : {"VP8L", "VP8X"}) {
    const auto webp = renderer::make_webp(frames);
    EXPECT_EQ(webp.substr(12, 4), kind);
    const auto [width, height] = read_webp_size(webp, "a.webp");
    EXPECT_EQ(width, WIDTH) << kind;
    EXPECT_EQ(height, HEIGHT) << kind;
    frames.push_back(frame);
  }
}

TEST(ExperimentsReport, Base64AsInTheStandard) {  // the examples of RFC 4648, section 10
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foob"), "Zm9vYg==");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace laboratory

// Outcomes of checks as JUnit XML and as TAP, read by independent parsers.
#include "experiments/laboratory/judge/test_report.hpp"

#include <expat.h>

#include <fstream>
#include <random>
#include <sstream>

#include "base/text.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

const std::string EXPERIMENT =
    "[program]\nname = \"message\"\n[sweep]\nbytes = [1, 100]\n"
    "[[check]]\nname = \"quick & <new>\"\nof = \"latency_s\"\nat_most = 1\n"
    "[[check]]\nname = \"slow #1\"\nof = \"latency_s\"\nat_most = 1e-9\n";

// An element of an XML document, with its attributes.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
};

std::vector<Element> read_elements(const std::string& xml) {
  std::vector<Element> elements;
  auto* parser = XML_ParserCreate(nullptr);
  XML_SetUserData(parser, &elements);
  XML_SetStartElementHandler(parser, [](void* data, const char* name, const char** attributes) {
    auto& element = static_cast<std::vector<Element>*>(data)->emplace_back(Element{name, {}});
    for (; *attributes; attributes += 2) element.attributes[attributes[0]] = attributes[1];
  });
  EXPECT_EQ(XML_Parse(parser, xml.data(), static_cast<int>(xml.size()), 1), XML_STATUS_OK) << xml;
  XML_ParserFree(parser);
  return elements;
}

std::vector<std::string> list_names(const std::vector<Element>& elements) {
  std::vector<std::string> names;
  for (const auto& element : elements) names.push_back(element.name);
  return names;
}

TEST(TestReport, EachCheckIsACaseWithItsPoints) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << EXPERIMENT;
  const auto done = tlab(folder.path, {"verify", "e.toml", "--junit", "e.xml", "--tap", "e.tap"});
  EXPECT_EQ(done.exit_code, 1);
  const auto xml = read_file(folder.path / "e.xml");
  auto elements = read_elements(xml);
  ASSERT_EQ(list_names(elements), (std::vector<std::string>{"testsuites", "testsuite", "testcase",
                                                            "system-out", "testcase", "failure"}));
  EXPECT_EQ(elements[1].attributes["name"], "e.toml");
  for (const int i : {0, 1}) {
    EXPECT_EQ(elements[i].attributes["tests"], "2");
    EXPECT_EQ(elements[i].attributes["failures"], "1");
    EXPECT_EQ(elements[i].attributes["errors"], "0");
  }
  EXPECT_EQ(elements[2].attributes["name"], "quick & <new>");
  EXPECT_EQ(elements[4].attributes["name"], "slow #1");
  EXPECT_TRUE(contains(elements[5].attributes["message"], "slow #1: latency_s at 2 point(s)"));
  // the table of simulated and expected values
  EXPECT_TRUE(contains(xml, "bytes  simulated")) << xml;

  const auto tap = read_file(folder.path / "e.tap");
  EXPECT_TRUE(tap.starts_with("TAP version 13\n1..2\nok 1 - e.toml: quick & <new>\n")) << tap;
  EXPECT_TRUE(contains(tap, "\nnot ok 2 - e.toml: slow \\#1\n")) << tap;
  EXPECT_TRUE(contains(tap, "    - \"bytes  simulated")) << tap;

  const auto again = tlab(folder.path, {"verify", "e.toml", "--junit", "f.xml"});
  EXPECT_EQ(read_file(folder.path / "f.xml"), xml);
}

TEST(TestReport, AnExperimentThatDoesNotRunIsAnError) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "a.toml") << EXPERIMENT;
  std::ofstream(folder.path / "b.toml") << EXPERIMENT << "[program]\nbyts = 3\n";
  const auto done = tlab(folder.path, {"verify", "a.toml", "b.toml", "--junit", "e.xml"});
  EXPECT_EQ(done.exit_code, 2);
  auto elements = read_elements(read_file(folder.path / "e.xml"));
  EXPECT_EQ(elements[0].attributes["tests"], "3");
  EXPECT_EQ(elements[0].attributes["errors"], "1");
  EXPECT_EQ(elements.back().name, "error");
}

TEST(TestReport, UnwritableReportsAreRefusedBeforeTheRun) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << EXPERIMENT;
  for (const auto* option : {"--junit", "--tap"}) {
    EXPECT_EQ(tlab(folder.path, {"verify", "e.toml", option, "none/e.xml"}).exit_code, 2);
    EXPECT_EQ(tlab(folder.path, {"verify", "e.toml", option, "e.toml"}).exit_code, 2);
  }
  EXPECT_EQ(tlab(folder.path, {"verify", "e.toml", "--tap", "e", "--junit", "e"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder.path / "results"));
  EXPECT_EQ(read_file(folder.path / "e.toml"), EXPERIMENT);
}

// Names and messages of random bytes give a single line of TAP each, and XML that the parser Expat
// reads.
TEST(TestReport, AnyTextIsValidInBothFormats) {
  const auto seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  auto draw_text = [&] {
    std::string text;
    for (auto length = random() % 12; length > 0; --length)
      text +=
          random() % 3 ? "#\\<>&\"'\n\r\t :-"[random() % 13] : static_cast<char>(random() % 256);
    return text;
  };
  for (int i = 0; i < 200; ++i) {
    std::vector<TestCase> cases;
    for (auto n = 1 + random() % 4; n > 0; --n)
      cases.push_back(
          {draw_text(), draw_text(), TestOutcome(random() % 4), draw_text(), draw_text()});
    read_elements(make_junit(cases));
    std::istringstream tap(make_tap(cases));
    std::size_t outcomes = 0;
    bool inside = false;  // true within a block of YAML
    for (std::string line; std::getline(tap, line);) {
      if (line == "  ---" || line == "  ...")
        inside = !inside;
      else if (!inside && (line.starts_with("ok ") || line.starts_with("not ok ")))
        ++outcomes;
      else if (!inside)
        EXPECT_TRUE(line.starts_with("TAP version") || line.starts_with("1..")) << line;
      else
        EXPECT_TRUE(line.starts_with("  ")) << line;
    }
    EXPECT_EQ(outcomes, cases.size());
  }
}

}  // namespace
}  // namespace laboratory

// Tests drawings of loads: their elements, read by an XML parser. The appearance was checked by
// eye.
#include "topologies/draw/load_drawing.hpp"

#include <fmt/format.h>

#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "tests/topologies/support.hpp"
#include "topologies/draw/layout.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

using Tree = boost::property_tree::ptree;

Loads make_loads(const Topology& t, unsigned seed) {
  std::mt19937 random(seed);
  const auto share = [&] { return static_cast<double>(random() % 1001) / 1000; };
  Loads loads{t.name, {}, {}};
  for (int p = 0; p < t.processors; ++p) loads.processors.push_back(share());
  for (size_t i = 0; i < t.links.size(); ++i) loads.links.push_back({share(), share()});
  loads.extras = {{"coordinator", share(), "", {share(), share()}},
                  {"database", share(), "coordinator", {share(), share()}}};
  return loads;
}

// Collects the tooltips of all elements of the class `of_class`.
void find_tips(const Tree& tree, const std::string& of_class, std::vector<std::string>& tips) {
  for (const auto& [name, child] : tree) {
    if (child.get("<xmlattr>.class", "") == of_class)
      tips.push_back(child.get<std::string>("a.<xmlattr>.xlink:title"));
    find_tips(child, of_class, tips);
  }
}

std::vector<std::string> tips_of(const std::string& svg, const std::string& of_class) {
  std::istringstream in(svg);
  Tree tree;
  read_xml(in, tree);  // throws if the SVG is not well-formed
  std::vector<std::string> tips;
  find_tips(tree, of_class, tips);
  return tips;
}

TEST(LoadDrawing, HasEveryProcessorAndBothDirectionsOfEveryLinkWithTheirShares) {
  for (const auto* spec :
       {"line:1", "line:20", "ring:9", "ring:50", "tree:40", "tree:100", "binary:31", "mesh:3x4",
        "torus:4x4", "torus:2x5", "hypercube:4", "amp:23", "star:5"}) {
    SCOPED_TRACE(spec);
    const auto t = make_topology(spec);
    const auto loads = make_loads(t, 1);
    const auto svg = to_load_svg(t, loads);
    const auto processors = tips_of(svg, "processor"), links = tips_of(svg, "link");
    EXPECT_EQ(processors.size(), t.processors + 2u);
    EXPECT_EQ(links.size(), 2 * t.links.size() + 4);
    std::set<std::string> all(processors.begin(), processors.end());
    all.insert(links.begin(), links.end());
    const auto told = [](double share) { return fmt::format(": busy {:.1f} %", 100 * share); };
    for (int p = 0; p < t.processors; ++p)
      EXPECT_TRUE(all.contains(fmt::format("processor {}", p) + told(loads.processors[p])));
    for (size_t i = 0; i < t.links.size(); ++i) {
      const auto a = t.links[i].a.processor, b = t.links[i].b.processor;
      EXPECT_TRUE(all.contains(fmt::format("processor {} to processor {}", a, b) +
                               told(loads.links[i][0])));
      EXPECT_TRUE(all.contains(fmt::format("processor {} to processor {}", b, a) +
                               told(loads.links[i][1])));
    }
    EXPECT_TRUE(all.contains("coordinator to processor 0" + told(loads.extras[0].link[0])));
    EXPECT_TRUE(all.contains("coordinator to database" + told(loads.extras[1].link[1])));
    EXPECT_EQ(svg, to_load_svg(t, loads));
  }
}

TEST(LoadDrawing, TakesAnyWiringAndAwkwardNames) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_topology(seed);
    auto loads = make_loads(t, seed);
    loads.title = "a \"quoted\" <title> & \\N \n {}";
    for (int p = 0; p < t.processors; ++p) loads.labels.push_back("<&\"\\G" + std::to_string(p));
    loads.extras[0].name = loads.extras[1].to = "the \"<centre>\" &amp; \\";
    const auto svg = to_load_svg(t, loads);
    const auto tips = tips_of(svg, "processor");
    EXPECT_EQ(tips.size(), t.processors + 2u);
    EXPECT_TRUE(std::ranges::any_of(
        tips, [&](auto& tip) { return tip.starts_with(loads.extras[0].name); }));
  }
}

// Collects the positions of the processors' names, which are also the centres of the processors.
void find_names(const Tree& tree, std::map<std::string, Place>& names) {
  for (const auto& [name, child] : tree) {
    if (child.get("<xmlattr>.class", "") == "processor") {
      const auto& text = child.get_child("a.text");
      names[text.data()] = {text.get<double>("<xmlattr>.x"), text.get<double>("<xmlattr>.y")};
    }
    find_names(child, names);
  }
}

// The middle of each row of extra processors is above the root. (y grows downwards in an SVG.)
TEST(LoadDrawing, ExtraProcessorsStandInRowsAboveTheRoot) {
  for (const char* spec : {"line:5", "ring:9", "tree:40", "mesh:3x4"}) {
    SCOPED_TRACE(spec);
    const auto t = make_topology(spec);
    auto loads = make_loads(t, 1);
    loads.extras = {{"left", 0, "", {}}, {"right", 0, "", {}}, {"above", 0, "left", {}}};
    std::istringstream in(to_load_svg(t, loads));
    Tree tree;
    read_xml(in, tree);
    std::map<std::string, Place> at;
    find_names(tree, at);
    const Place root = at.at(std::to_string(t.root)), left = at.at("left"), right = at.at("right"),
                above = at.at("above");
    EXPECT_LT(left.x, right.x);
    EXPECT_NEAR((left.x + right.x) / 2, root.x, 0.1);
    EXPECT_NEAR(above.x, root.x, 0.1);
    EXPECT_NEAR(left.y, right.y, 0.1);
    EXPECT_GT(root.y, left.y + 20);
    EXPECT_GT(left.y, above.y + 20);
  }
}

TEST(LoadDrawing, ColoursGetDarkerWithLoad) {
  double last = std::numeric_limits<double>::max();
  for (int share = 0; share <= 100; ++share) {
    const auto colour = load_colour(share / 100.0);
    ASSERT_EQ(colour.size(), 7u);
    const auto part = [&](size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16); };
    const double light = 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
    EXPECT_LT(light, last) << share;
    last = light;
  }
}

TEST(LoadDrawing, MistakesAreNamed) {
  const auto t = make_topology("ring:4");
  const auto told = [&](auto change) {
    auto loads = make_loads(t, 1);
    change(loads);
    return rejection([&] { to_load_svg(t, loads); });
  };
  const auto expect = [&](const std::string& words, auto change) {
    const auto message = told(change);
    EXPECT_TRUE(message.starts_with("loads of topology ring:4: ")) << message;
    EXPECT_NE(message.find(words), message.npos) << message;
  };
  expect("found 3 processors, expected 4", [](Loads& l) { l.processors.pop_back(); });
  expect("found 5 links, expected 4", [](Loads& l) { l.links.push_back({}); });
  expect("found 1 labels, expected 4 or none", [](Loads& l) { l.labels = {"x"}; });
  expect("found 1.5 for processor 2, expected 0 to 1", [](Loads& l) { l.processors[2] = 1.5; });
  expect("found -0.5 for link 3", [](Loads& l) { l.links[3][1] = -0.5; });
  expect("found nan for processor 0", [](Loads& l) { l.processors[0] = std::nan(""); });
  expect("found 2 for database", [](Loads& l) { l.extras[1].load = 2; });
  expect("called \"coordinator\"", [](Loads& l) { l.extras[1].name = "coordinator"; });
  expect("called \"\"", [](Loads& l) { l.extras[1].name = ""; });
  expect("wired to \"display\"", [](Loads& l) { l.extras[1].to = "display"; });
  expect("wired to \"database\"", [](Loads& l) { l.extras[0].to = "database"; });
}

// No two processors are nearer than 0.8 units. The diameter of a processor is 0.75 units.
TEST(LoadLayout, ProcessorsDoNotTouch) {
  for (const auto& spec : SPECS) {
    const auto places = make_layout(make_topology(spec)).processors;
    for (size_t p = 0; p < places.size(); ++p)
      for (size_t q = 0; q < p; ++q)
        EXPECT_GT(std::hypot(places[p].x - places[q].x, places[p].y - places[q].y), 0.8)
            << spec << ": " << q << " and " << p;
  }
}

}  // namespace
}  // namespace topologies

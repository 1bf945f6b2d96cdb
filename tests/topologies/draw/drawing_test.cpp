// Tests drawings of topologies: layouts, and positions of elements in the SVG, read by an XML
// parser.
#include "topologies/draw/drawing.hpp"

#include <gtest/gtest.h>

#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "tests/topologies/support.hpp"
#include "topologies/draw/layout.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

using Tree = boost::property_tree::ptree;

Place place_of(const Tree& element, const char* x, const char* y) {
  const auto& attributes = element.get_child("<xmlattr>");
  return {attributes.get<double>(x), attributes.get<double>(y)};
}

double distance(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Positions of elements in a drawing: circles by processor, and port numbers by link, in the SVG's
// order (the second end of a link first).
struct Drawn {
  std::map<std::string, std::vector<Place>> circles;
  std::map<std::string, std::vector<std::pair<std::string, Place>>> ports;
};

Drawn read_drawing(const std::string& svg) {
  std::istringstream in(svg);
  Tree tree;
  read_xml(in, tree);
  Drawn drawn;
  for (const auto& [name, group] : tree.get_child("svg.g")) {
    const auto of_class = group.get("<xmlattr>.class", "");
    for (const auto& [kind, element] : group) {
      const auto title = group.get("title", "");
      if (of_class == "node" && kind == "ellipse")
        drawn.circles[title].push_back(place_of(element, "cx", "cy"));
      if (of_class == "edge" && kind == "text")
        drawn.ports[title].emplace_back(element.data(), place_of(element, "x", "y"));
    }
  }
  return drawn;
}

// The root has a second circle. The label with the port number of a link's end is near the end's
// processor: 0.6 units from its centre along the link, and 0.16 units to the side.
TEST(Drawing, ShowsTheRootAndWritesPortsBesideTheirProcessors) {
  if (std::system("dot -V 2> /dev/null") != 0) GTEST_SKIP() << "Graphviz is missing";
  // In points. BASELINE is the distance from the middle of a letter to its baseline.
  constexpr double UNIT = 36, BASELINE = 2;
  for (const auto* spec : {"ring:3", "ring:7", "torus:4x4", "tree:7", "star:5", "amp:12"}) {
    SCOPED_TRACE(spec);
    const auto t = make_topology(spec);
    auto drawn = read_drawing(to_svg(t));
    ASSERT_EQ(drawn.circles.size(), static_cast<size_t>(t.processors));
    for (int p = 0; p < t.processors; ++p)
      EXPECT_EQ(drawn.circles[std::to_string(p)].size(), p == t.root ? 2u : 1u) << p;
    for (const auto& [a, b] : t.links) {
      const auto from = std::to_string(a.processor), to = std::to_string(b.processor);
      const auto ports = drawn.ports[from + "--" + to];
      ASSERT_EQ(ports.size(), 2u) << from << " " << to;
      EXPECT_EQ(ports[0].first, std::to_string(b.port));
      EXPECT_EQ(ports[1].first, std::to_string(a.port));
      for (const auto& [port, processor] : {std::pair(1, from), {0, to}}) {
        Place at = ports[port].second;
        at.y -= BASELINE;
        EXPECT_NEAR(distance(at, drawn.circles[processor][0]), UNIT * std::hypot(0.6, 0.16), 1)
            << from << " " << to;
      }
    }
  }
}

// The midpoint of a Bezier curve with control points a, b, c, d is (a + 3 b + 3 c + d) / 8. It must
// differ from the midpoint of the straight line by the swerve.
TEST(Layout, CurvesAreOffTheLineByTheirSwerveHalfWay) {
  std::mt19937 random(1);
  const auto place = [&] {
    const double x = static_cast<double>(random() % 100) / 10;
    return Place{x, static_cast<double>(random() % 100) / 10};
  };
  for (int i = 0; i < 100; ++i) {
    const Place from = place(), to = place(), swerve = place();
    const auto [a, b, c, d] = make_curve(from, to, swerve);
    EXPECT_EQ(distance(a, from) + distance(d, to), 0);
    const Place half{(a.x + 3 * b.x + 3 * c.x + d.x) / 8, (a.y + 3 * b.y + 3 * c.y + d.y) / 8};
    EXPECT_NEAR(half.x, (from.x + to.x) / 2 + swerve.x, 1e-12);
    EXPECT_NEAR(half.y, (from.y + to.y) / 2 + swerve.y, 1e-12);
  }
}

TEST(Layout, PlacesEveryProcessorAndLink) {
  for (const auto& spec : SPECS) {
    const auto t = make_topology(spec);
    const auto layout = make_layout(t);
    EXPECT_EQ(layout.processors.size(), static_cast<size_t>(t.processors)) << spec;
    EXPECT_EQ(layout.swerves.size(), t.links.size()) << spec;
  }
}

// A large network must use the layout in rings. Graphviz would take seconds to place a thousand
// processors, and minutes for ten thousand.
TEST(Layout, OfALargeNetworkIsInRingsAroundItsRoot) {
  auto t = make_mesh(64, 128);
  t.shape = {};
  const auto places = make_layout(t).processors;
  t.shape = {Shape::Form::around_root};
  const auto rings = make_layout(t).processors;
  for (int p = 0; p < t.processors; ++p) EXPECT_EQ(distance(places[p], rings[p]), 0) << p;
}

TEST(Layout, HasALimit) {
  EXPECT_EQ(make_layout(make_topology("mesh:128x128")).processors.size(), 16384U);
  EXPECT_EQ(rejection([] { to_svg(make_topology("mesh:256x256")); }),
            "topology mesh:256x256: found 65536 processors, expected at most 16384 in a drawing "
            "(formats dot, graphml and csv have no limit)");
}

// A row holds up to sixteen processors. A line has as few rows as possible.
TEST(Layout, ALineOfMoreThan16HasRows) {
  for (const auto& [processors, rows] : {std::pair(16, 1), {17, 2}, {32, 2}, {33, 3}}) {
    std::set<double> heights;
    for (const Place& place : make_layout(make_line(processors)).processors)
      heights.insert(place.y);
    EXPECT_EQ(heights.size(), static_cast<std::size_t>(rows)) << processors;
  }
}

// Neighbours in a ring are close together in the drawing, for any size and number of rows.
TEST(Layout, NeighboursInARingStandTogether) {
  for (int n = 3; n <= 300; ++n) {
    const auto t = make_ring(n);
    const auto places = make_layout(t).processors;
    ASSERT_EQ(places.size(), static_cast<size_t>(n));
    for (const auto& [a, b] : t.links)
      EXPECT_LT(distance(places[a.processor], places[b.processor]), 2)
          << n << ": " << a.processor << " " << b.processor;
  }
}

}  // namespace
}  // namespace topologies

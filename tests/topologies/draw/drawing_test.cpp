// Tests drawings of topologies: layouts, and positions of elements in the SVG, read by an XML
// parser.
#include "topologies/draw/drawing.hpp"

#include <gtest/gtest.h>

#include <boost/property_tree/xml_parser.hpp>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "tests/topologies/support.hpp"
#include "topologies/draw/layout.hpp"
#include "topologies/draw/port_places.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

using Tree = boost::property_tree::ptree;

Place place_of(const Tree& element, const char* x, const char* y) {
  const auto& attributes = element.get_child("<xmlattr>");
  return {attributes.get<double>(x), attributes.get<double>(y)};
}

double distance(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Elements of a drawing. `circles`: by the name of a processor, its circles. `ports`: for each
// link, the numbers and places of its two ports, the first end's port first. `curves`: the control
// points of each link.
struct Drawn {
  std::map<std::string, std::vector<Place>> circles;
  std::vector<std::vector<std::pair<std::string, Place>>> ports;
  std::vector<std::array<Place, 4>> curves;
  std::string width, font;
};

std::array<Place, 4> read_curve(std::string path) {
  for (char& c : path)
    if (!std::isdigit(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = ' ';
  std::istringstream in(path);
  std::array<Place, 4> curve;
  for (auto& [x, y] : curve) in >> x >> y;
  return curve;
}

Drawn read_drawing(const std::string& svg) {
  constexpr double BASELINE = 0.36;  // from a letter's middle to its foot
  std::istringstream in(svg);
  Tree tree;
  read_xml(in, tree);
  Drawn drawn;
  drawn.width = tree.get<std::string>("svg.<xmlattr>.width");
  drawn.font = tree.get<std::string>("svg.<xmlattr>.font-family");
  for (const auto& [name, group] : tree.get_child("svg")) {
    const auto of_class = group.get("<xmlattr>.class", "");
    if (name == "path") drawn.curves.push_back(read_curve(group.get<std::string>("<xmlattr>.d")));
    if (of_class == "link") drawn.ports.emplace_back();
    if (of_class != "link" && of_class != "processor") continue;
    const auto& inside = group.get_child("a");
    const auto tip = inside.get<std::string>("<xmlattr>.xlink:title");
    for (const auto& [kind, element] : inside) {
      if (kind == "circle") drawn.circles[tip].push_back(place_of(element, "cx", "cy"));
      if (kind != "text" || of_class != "link") continue;
      auto at = place_of(element, "x", "y");
      at.y -= BASELINE * element.get<double>("<xmlattr>.font-size");
      drawn.ports.back().emplace_back(element.data(), at);
    }
  }
  return drawn;
}

// The root has a second circle around its own. The number of a port stands beside its processor:
// outside the circle by the size of a letter, along the link, and 0.72 times this size to the side.
TEST(Drawing, ShowsTheRootAndWritesPortsBesideTheirProcessors) {
  constexpr double RADIUS = 13.5, LETTER = 8;  // points
  for (const auto* spec : {"line:3", "ring:7", "mesh:3x4", "tree:7", "star:5"}) {
    SCOPED_TRACE(spec);
    const auto t = make_topology(spec);
    auto drawn = read_drawing(to_svg(t));
    ASSERT_EQ(drawn.circles.size(), static_cast<size_t>(t.processors));
    for (int p = 0; p < t.processors; ++p)
      EXPECT_EQ(drawn.circles[std::to_string(p)].size(), p == t.root ? 2u : 1u) << p;
    ASSERT_EQ(drawn.ports.size(), t.links.size());
    for (std::size_t i = 0; i < t.links.size(); ++i) {
      const auto& [a, b] = t.links[i];
      ASSERT_EQ(drawn.ports[i].size(), 2u);
      EXPECT_EQ(drawn.ports[i][0].first, std::to_string(a.port));
      EXPECT_EQ(drawn.ports[i][1].first, std::to_string(b.port));
      for (const auto& [end, processor] : {std::pair(0, a.processor), {1, b.processor}})
        EXPECT_NEAR(
            distance(drawn.ports[i][end].second, drawn.circles[std::to_string(processor)][0]),
            std::hypot(RADIUS + LETTER, 0.72 * LETTER), 0.1)
            << i;
    }
  }
}

// A user's graph has links of different directions and lengths, and processors in between.
TEST(Drawing, OfAnyGraphKeepsPortsApartAndLinksClearOfOtherProcessors) {
  if (std::system("dot -V 2> /dev/null") != 0) GTEST_SKIP() << "Graphviz is missing";
  constexpr double RADIUS = 13.5, LETTER = 0.6 * 8;  // points; width of a digit
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    auto t = random_topology(seed);
    t.shape = {};
    const auto drawn = read_drawing(to_svg(t));
    EXPECT_EQ(drawn.font, "sans-serif");
    std::vector<Place> ports, processors;
    for (const auto& link : drawn.ports)
      for (const auto& port : link) ports.push_back(port.second);
    for (const auto& [name, circles] : drawn.circles) processors.push_back(circles[0]);
    for (std::size_t i = 0; i < ports.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT(distance(ports[i], ports[k]), LETTER) << i << " " << k;
    for (const auto& curve : drawn.curves)
      for (const auto& processor : processors) {
        if (distance(processor, curve[0]) < 0.1 || distance(processor, curve[3]) < 0.1) continue;
        for (int i = 0; i <= 50; ++i)
          EXPECT_GT(distance(processor, eval_curve(curve, i / 50.0)), RADIUS);
      }
  }
}

// A third processor stands where the port number would be: beside the link, to the left. The number
// must move to the right.
TEST(Drawing, PutsAPortOnTheSideWhereNoProcessorIs) {
  constexpr double SIZE = 0.2, RADIUS = 0.1;
  auto t = make_line(2);
  t.processors = 3;
  for (const double x : {0.5, 0.9, 7.3})
    for (const double y : {0.5, 0.9, 7.3}) {
      SCOPED_TRACE(testing::Message() << x << " " << y);
      const Places processors = {{x, y}, {x + 5, y}, {x + RADIUS + SIZE, y + 0.72 * SIZE}};
      const Layout layout{processors, {Place{}}};
      const Place port = place_ports(t, layout, SIZE, RADIUS)[0][0];
      EXPECT_NEAR(port.x, x + RADIUS + SIZE, 1e-9);
      EXPECT_NEAR(port.y, y - 0.72 * SIZE, 1e-9);
    }
}

TEST(Drawing, OfAFigureHasItsWidthAndNoPaper) {
  const base::FigureStyle style{.width_mm = 85, .font = "Liberation Serif"};
  const auto svg = to_svg(make_topology("mesh:4x4"), style);
  const auto drawn = read_drawing(svg);
  EXPECT_EQ(drawn.width, "85mm");
  EXPECT_EQ(drawn.font, "Liberation Serif");
  EXPECT_NE(svg.find("font-size=\"8.00\""), svg.npos);
  EXPECT_EQ(svg.find("paper"), svg.npos);
  EXPECT_NE(to_svg(make_topology("mesh:4x4")).find("class=\"paper\""), svg.npos);
}

// The midpoint of a Bezier curve is (a + 3 b + 3 c + d) / 8.
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

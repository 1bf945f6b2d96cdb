#include "topologies/files/formats.hpp"

#include "tests/support/files.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/draw/drawing.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

void expect_same_wiring(const Topology& found, const Topology& expected) {
  EXPECT_EQ(found.processors, expected.processors);
  EXPECT_EQ(found.root, expected.root);
  EXPECT_EQ(found.links, expected.links);
  EXPECT_EQ(found.labels, expected.labels);
}

void expect_round_trips(const Topology& t) {
  expect_same_wiring(read_dot(to_dot(t), t.name), t);
  expect_same_wiring(read_graphml(to_graphml(t), t.name), t);
  EXPECT_EQ(to_dot(read_dot(to_dot(t), t.name)), to_dot(t));
  EXPECT_EQ(to_graphml(read_graphml(to_graphml(t), t.name)), to_graphml(t));
}

class TopologyFormats : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, TopologyFormats, testing::ValuesIn(SPECS), SpecName());
TEST_P(TopologyFormats, RoundTrip) { expect_round_trips(make_topology(GetParam())); }

TEST(TopologyRandomFormats, RoundTripWithPortsRootAndAwkwardLabels) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto t = random_topology(seed);
    expect_round_trips(t);
    for (int p = 0; p < t.processors; ++p)
      t.labels.push_back("a \"quoted\" <name> & " + std::to_string(t.processors - p));
    expect_round_trips(t);
  }
}

// Names that XML or JSON could not hold, or that would change when read again.
TEST(TopologyNames, AreUtf8WithoutControlCharactersAndBlanksAtTheirEnds) {
  auto ring = make_topology("ring:3");
  for (const auto* name : {"a b", "a\nb", "\xc3\xa9", "a\x7f"}) {
    ring.labels = {name, "b", "c"};
    expect_round_trips(ring);
  }
  const auto refused = [](const auto& read) {
    return test::message_of<base::BadInput>(read).find("found a vertex called ") !=
           std::string::npos;
  };
  for (const auto* name : {"", " a", "a ", "a\n", "a\x06", "a\r", "a\xff"}) {
    EXPECT_TRUE(refused([&] {
      read_dot("graph G { \"" + std::string(name) + "\" -- \"b\" }", "f.dot");
    })) << name;
    EXPECT_TRUE(refused([&] {
      read_graphml("<graphml><graph><node id=\"" + std::string(name) + "\"/></graph></graphml>",
                   "f.graphml");
    })) << name;
  }
  EXPECT_TRUE(refused([] {
    read_graphml("<graphml><graph><node id=\"a&#13;\"/></graph></graphml>", "f.graphml");
  }));
}

TEST(TopologyDot, NamesMayBeThoseOfGraphsAndGroupsAndKeywords) {
  auto ring = make_topology("ring:4");
  for (const std::vector<std::string>& labels :
       {std::vector<std::string>{"one", "G", "two", "three"},
        {"b", "a", "node", "GRAPH"},
        {"x", "edge", "subgraph", "-5"},
        {".", "\\n", "a\\b", "1.5"}}) {
    ring.labels = labels;
    expect_round_trips(ring);
  }
  EXPECT_EQ(read_dot("graph g { subgraph s { a } a -- s; s -- g }", "x.dot").labels,
            (std::vector<std::string>{"a", "s", "g"}));
}

TEST(TopologyDot, RefusesToWriteWhatItCannotHold) {
  auto ring = make_topology("ring:3");
  for (const char* label : {"a\\", "a\\\"b"}) {
    ring.labels = {"x", label, "y"};
    EXPECT_THROW(to_dot(ring), base::BadInput) << label;
    expect_same_wiring(read_graphml(to_graphml(ring), "x"), ring);
  }
  ring.labels = {};
  ring.name = "a\\";
  expect_same_wiring(read_dot(to_dot(ring), "x"), ring);
}

std::string repeat(int times, const std::string& part) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(TopologyGraphMl, ElementsMayBeNestedHoweverDeep) {
  constexpr int LEVELS = 140'000;
  for (const char* open :
       {"<x>", "<x y='/>'>", "<x><!-- </x> -->", "<x><![CDATA[</x>]]>", "<x><?p </x> ?>"})
    EXPECT_EQ(read_graphml("<graphml><graph><node id='a'/>" + repeat(LEVELS, open) +
                               repeat(LEVELS, "</x>") + "</graph></graphml>",
                           "deep.graphml")
                  .processors,
              1)
        << open;
}

TEST(TopologyGraphMl, ManyNamesMayLookLikeElements) {
  std::string text = "<graphml><graph>";
  for (int p = 0; p < 300; ++p) text += fmt::format("<node id='a{}&lt;>1'/>", p);
  for (int p = 1; p < 300; ++p)
    text += fmt::format("<edge source='a{}&lt;>1' target='a{}&lt;>1'/>", p - 1, p);
  const auto t = read_graphml(text + "</graph></graphml>", "names.graphml");
  EXPECT_EQ(t.processors, 300);
  EXPECT_EQ(t.labels[1], "a1<>1");
}

TEST(TopologyDot, NumbersVerticesAsTheFileNamesThem) {
  const auto t = read_dot(R"(/* not: first */ graph "net" { // comment
    node [color=red]; host; "w 10" [label="host"]; w2;
    host -- w2 -- "w 10"; { rank=same; w2; w3 } w3 -- host; subgraph s { w3 -- w4 } })",
                          "net.dot");
  EXPECT_EQ(t.labels, (std::vector<std::string>{"host", "w 10", "w2", "w3", "w4"}));
  EXPECT_EQ(t.root, 0);
  EXPECT_EQ(describe_processor(t, 1), "\"w 10\"");
}

// Line markers of a C preprocessor: they name no vertices.
TEST(TopologyDot, LinesThatBeginWithAHashAreComments) {
  const auto t = read_dot("# 1 \"net.dot\"\ngraph {\n# b -- a\na -- b // c\n}\n", "net.dot");
  EXPECT_EQ(t.labels, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(t.links.size(), 1u);
}

TEST(TopologyDot, KeepsNumbersThatAreNames) {
  const auto t = read_dot("graph { 11--10--9--8--7--6--5--4--3--2--1--0 }", "n.dot");
  EXPECT_TRUE(t.labels.empty());
  for (int p = 0; p < 11; ++p) EXPECT_EQ(t.links[p].b.processor, p + 1);
}

TEST(TopologyDot, AssignsFreePortsInTheOrderOfEdges) {
  const auto t = read_dot(
      "graph { 0 -- 1 [port_a=1]; 3 -- 0 [headport=0, tailport=2]; 0 -- 2 [port_b=3, tailport=n];"
      " 4 -- 0 }",
      "ports.dot");
  const std::vector<Link> expected{
      {{0, 1}, {1, 0}}, {{0, 2}, {2, 3}}, {{0, 0}, {3, 2}}, {{0, 3}, {4, 0}}};
  EXPECT_EQ(t.links, expected);
}

TEST(TopologyDot, RootIsAGraphOrVertexAttribute) {
  for (const auto* text : {"graph { root=c; a -- b -- c }", "graph { graph [root=c]; a -- b -- c }",
                           "graph { a -- b -- c; c [root=true] }",
                           "graph { a [root=False]; a -- b -- c; c [root=True] }",
                           "digraph { root=c; c [root=1]; a [root=false];"
                           " a -> b -> c }"}) {
    const auto t = read_dot(text, "root.dot");
    EXPECT_EQ(describe_processor(t, t.root), "\"c\"") << text;
  }
}

constexpr auto YED = R"(<?xml version="1.0"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="d0" for="edge" attr.name="port_a" attr.type="int"/>
<key id="d1" for="node" attr.name="root" attr.type="boolean"><default>false</default></key>
<key id="d2" for="node" yfiles.type="nodegraphics"/>
<graph id="G" edgedefault="directed">
<node id="z"/><node id="b"><data key="d1">true</data><data key="d2">x</data></node>
<edge source="z" target="b"><data key="d0">3</data></edge>
</graph></graphml>)";

TEST(TopologyGraphml, ReadsWhatAnEditorWrites) {
  const auto t = read_graphml(YED, "yed.graphml");
  EXPECT_EQ(t.labels, (std::vector<std::string>{"z", "b"}));
  EXPECT_EQ(t.root, 1);
  EXPECT_EQ(t.links, (std::vector<Link>{{{0, 3}, {1, 0}}}));
}

TEST(TopologyFiles, AreSpecsByTheirExtension) {
  for (const auto* name : {"a.dot", "a.gv", "a.graphml"}) {
    const auto ring = make_topology("ring:12");
    const bool graphml = std::string(name) == "a.graphml";
    const TemporaryFile file(name, graphml ? to_graphml(ring) : to_dot(ring));
    const auto t = make_topology(file.path);
    EXPECT_EQ(t.name, file.path);
    expect_same_wiring(t, ring);
  }
}

TEST(TopologyTexts, CsvHasARowPerLink) {
  EXPECT_EQ(to_csv(make_topology("tree:3")),
            "processor_a,port_a,processor_b,port_b\n0,1,1,0\n0,2,2,0\n");
}

TEST(TopologyTexts, MetricsAreATable) {
  EXPECT_EQ(to_metrics(make_topology("tree:7")),
            "topology                tree:7\n"
            "processors              7\n"
            "root                    0\n"
            "links                   6\n"
            "links per processor     1 to 3\n"
            "diameter                4\n"
            "mean distance           2.2857\n"
            "bisection width         2\n"
            "busiest, farm           2 messages, 0 to 1\n"
            "busiest, all to all     10 messages, 0 to 1\n");
}

TEST(TopologySvg, IsDrawnOrSaysThatGraphvizIsMissing) {
  if (std::system("dot -V 2> /dev/null") == 0)
    for (const auto* spec : {"tree:7", "mesh:3x3", "line:1"}) {
      const auto svg = to_svg(make_topology(spec));
      EXPECT_NE(svg.find("<svg"), svg.npos);
      EXPECT_NE(svg.find("</svg>"), svg.npos);
    }
  // Positions come from the shape: neighbours of a mesh are 1.6 units of 36 points apart.
  const auto mesh = to_svg(make_topology("mesh:16x16"));
  EXPECT_NE(mesh.find("width=\"9"), mesh.npos) << mesh.substr(0, 800);
  const std::string path = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  try {
    to_svg(make_topology("ring:3"));
    ADD_FAILURE() << "drawn without Graphviz";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("install graphviz"), std::string::npos);
  }
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace topologies

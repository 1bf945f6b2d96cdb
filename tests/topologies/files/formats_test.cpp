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

// Names are refused if XML or JSON cannot hold them, or if they would change when read again.
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
  }
  for (const auto* name : {" a", "a ", "a\n", "a\r"})
    EXPECT_TRUE(refused([&] {
      read_graphml("<graphml><graph><node id=\"" + std::string(name) + "\"/></graph></graphml>",
                   "f.graphml");
    })) << name;
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
        {".", "\\n", "a\\b", "1.5"},
        {"a\\\\", "\\\\\"b", "-.5", "<b>"}}) {
    ring.labels = labels;
    expect_round_trips(ring);
  }
  EXPECT_EQ(read_dot("graph g { subgraph s { a } a -- s; s -- g }", "x.dot").labels,
            (std::vector<std::string>{"a", "s", "g"}));
}

TEST(TopologyDot, RefusesToWriteWhatItCannotHold) {
  auto ring = make_topology("ring:3");
  for (const char* label : {"a\\", "a\\\"b", "a\\\\\\"}) {
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

// Expects names in the order of first mention, and the number of links.
TEST(TopologyDot, IsReadAsGraphvizReadsIt) {
  struct Case {
    std::string text;
    std::vector<std::string> names;
    std::size_t links;
  };
  for (const auto& [text, names, links] : {
           Case{"strict graph { a -- b; b -- c; c -- a; a -- b; b -- a; }", {"a", "b", "c"}, 3},
           Case{"strict digraph { a -> b; a -> b; b -> a }", {"a", "b"}, 2},
           Case{R"(graph { "a" + "b" -- "c"; "ab" -- d; })", {"ab", "c", "d"}, 2},
           Case{"graph { -1 -- 0; 0 -- 1; 1 -- -1; }", {"-1", "0", "1"}, 3},
           Case{"graph { -.5--1.--007 }", {"-.5", "1.", "007"}, 2},
           Case{"graph { a [label=<<table><tr><td port=\"p\">A &amp; B</td></tr></table>>];"
                " a -- b [label=<x<br/>y>]; b--c }",
                {"a", "b", "c"},
                2},
           Case{"graph { <<i>x</i>> -- <b>; \"b\" -- c }", {"<i>x</i>", "b", "c"}, 2},
           Case{"graph { Köln -- Zürich -- \"São Paulo\"; }", {"Köln", "Zürich", "São Paulo"}, 2},
           Case{"// head\n/* multi\n line -- x */\n# 1 \"net.dot\"\ngraph { a -- b // c -- d\n"
                " # 1 \"foo\"\n b -- c /* -- z */ ; # trailing hash\n c -- d }",
                {"a", "b", "c", "d"},
                3},
           Case{"\xef\xbb\xbfGRAPH \"x\" + \"y\" { Node [a=b]; SubGraph s { a } -- b }",
                {"a", "b"},
                1},
           Case{"graph { {a b} -- {c d}; a, b -- e }", {"a", "b", "c", "d", "e"}, 6},
           Case{"graph { subgraph s {a} subgraph s {b} -- c }", {"a", "b", "c"}, 2},
           Case{"graph { a -- {b -- c} -- d [x=y][]; }", {"a", "b", "c", "d"}, 5},
           Case{"graph { a -- b [key=1]; b -- a [key=1]; a -- b [key=2] }", {"a", "b"}, 2},
           Case{"graph { a -- {} -- b; a -- b }", {"a", "b"}, 1},
           Case{"graph { { subgraph { a } b } -- c }", {"a", "b", "c"}, 2},
           Case{R"(graph { "a\"b" -- "c\
d" -- "e\f" })",
                {"a\"b", "cd", "e\\f"},
                2},
       }) {
    const auto t = read_dot(text, "net.dot");
    EXPECT_EQ(t.labels, names) << text;
    EXPECT_EQ(t.links.size(), links) << text;
  }
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

// In a strict undirected graph, b -- a means the edge a -- b if this edge exists already.
TEST(TopologyDot, PortsAreThoseOfNodesAndOfDefaults) {
  for (const auto* text :
       {"graph { 0:1 -- 1:2:ne }", "graph { edge [port_a=1]; 0 -- 1:3 [headport=\"2:n\"] }",
        "graph { subgraph { edge [tailport=1]; 0 -- 1 [port_b=2] } }",
        "graph { edge [port_a=1, headport=2]; subgraph { { 0 -- 1 } } }",
        "strict graph { 0 -- 1; 1:2 -- 0:1 }", "graph { 0:3 -- 1 [key=x]; 1:2 -- 0:1 [key=x] }",
        "graph { 0:f0 -- 1 [port_a=1, port_b=2] }"})
    EXPECT_EQ(read_dot(text, "x.dot").links, (std::vector<Link>{{{0, 1}, {1, 2}}})) << text;
}

TEST(TopologyDot, DefaultsHoldForNewVerticesOfTheirSubgraph) {
  for (const auto* text : {"graph { a -- b; { node [root=true]; b c } c -- b }",
                           "graph { a -- b; subgraph s { node [root=1] } subgraph s { c } c -- b }",
                           "graph { a -- b; node [root=1]; { node [root=0] x } x -- b; c -- b }"}) {
    const auto t = read_dot(text, "root.dot");
    EXPECT_EQ(describe_processor(t, t.root), "\"c\"") << text;
  }
}

TEST(TopologyDot, RootIsAGraphOrVertexAttribute) {
  for (const auto* text : {"graph { root=c; a -- b -- c }", "graph { graph [root=c]; a -- b -- c }",
                           "graph { a -- b -- c; c [root=true] }",
                           "graph { a [root=False]; a -- b -- c; c [root=TRUE] }",
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

TEST(TopologyGraphml, ReadsPortsPrefixesAndDefaults) {
  const std::string begin =
                        "<?xml version='1.0'?><!DOCTYPE g:graphml [<!ENTITY b 'b'>]>"
                        "<g:graphml xmlns:g='http://graphml.graphdrawing.org/xmlns' "
                        "xmlns='http://elsewhere'><g:desc><g:graph/></g:desc>"
                        "<g:key id='r' for='node' attr.name='root'><g:default>0</g:default>"
                        "</g:key><g:key id='q' attr.name='headport'><g:default>2</g:default>"
                        "</g:key><g:graph edgedefault='undirected'><edge source='a' target='a'/>",
                    a = "<g:node id='a'><g:port name='3'><g:port name='x'/></g:port></g:node>",
                    b = "<g:node id='&b;'><g:data key='r'> 1\n</g:data></g:node>",
                    edge = "<g:edge source='a' target='b' sourceport='3'/>",
                    end = "</g:graph></g:graphml>";
  for (const auto& text : {begin + a + b + edge + end, "\xef\xbb\xbf" + begin + a + b + edge + end,
                           begin + edge + b + a + end}) {
    const auto t = read_graphml(text, "x.graphml");
    ASSERT_EQ(t.processors, 2);
    EXPECT_EQ(t.labels[t.root], "b");
    const auto [one, other] = t.links.at(0);
    EXPECT_EQ(t.labels[one.processor] == "a" ? one.port : other.port, 3);
    EXPECT_EQ(t.labels[one.processor] == "a" ? other.port : one.port, 2);
  }
}

TEST(TopologyFiles, NamesOfPortsThatAreNoNumbersAreLeftOutAndReported) {
  const auto dot = [](const std::string& port) {
    return to_metrics(read_dot("graph { a:" + port + " -- b }", "x.dot"));
  };
  const auto graphml = read_graphml(
      "<graphml><graph><node id='a'/><node id='b'/>"
      "<edge source='a' target='b' targetport='north'/>"
      "</graph></graphml>",
      "x.graphml");
  const std::string row =
      "\nport names              ignored, because they are not numbers from 0 to 3\n";
  EXPECT_NE(dot("f0").find(row), std::string::npos);
  EXPECT_NE(to_metrics(graphml).find(row), std::string::npos);
  for (const auto* port : {"ne", "_", "3", "\"3:w\""})
    EXPECT_EQ(dot(port).find("port names"), std::string::npos) << port;
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

TEST(TopologySvg, NeedsGraphvizOnlyForGraphsOfNoKnownShape) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  // Positions come from the shape: neighbours in a mesh are 1.6 units apart, and a unit is 36
  // points.
  const auto mesh = to_svg(make_topology("mesh:16x16"));
  EXPECT_NE(mesh.find("width=\"9"), mesh.npos) << mesh.substr(0, 800);
  auto graph = make_topology("ring:3");
  graph.shape = {};
  try {
    to_svg(graph);
    ADD_FAILURE() << "drawn without Graphviz";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("install graphviz"), std::string::npos);
  }
  setenv("PATH", path.c_str(), 1);
  if (std::system("dot -V 2> /dev/null") != 0) return;
  EXPECT_NE(to_svg(graph).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace topologies

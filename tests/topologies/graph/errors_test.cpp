#include "tests/topologies/support.hpp"
#include "topologies/files/formats.hpp"
#include "topologies/make/amp.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

struct Case {
  std::string input;
  std::vector<std::string> told;  // texts that the message must contain
};

template <typename Act>
void expect_rejected(const std::vector<Case>& cases, Act act) {
  for (const auto& [input, told] : cases) {
    const auto message = rejection([&] { act(input); });
    EXPECT_NE(message, "") << "accepted: " << input;
    for (const auto& words : told)
      EXPECT_NE(message.find(words), message.npos)
          << input << "\n  told:     " << message << "\n  expected: " << words;
  }
}

TEST(TopologyErrors, Specs) {
  const std::string limit = "expected at most 65536";
  expect_rejected(
      {{"line:8x", {"\"line:8x\"", "found \"8x\"", "line:N", "N >= 1"}},
       {"line:", {"found \"\"", "line:N"}},
       {"line", {"found \"\"", "line:N"}},
       {"line:-3", {"found \"-3\"", "line:N"}},
       {"line:+3", {"found \"+3\""}},
       {"line: 3", {"found \" 3\""}},
       {"line:2.5", {"found \"2.5\""}},
       {"line:0", {"line:0", "at least 1"}},
       {"line:3:4", {"found 2 size(s)", "line:N"}},
       {"ring:2", {"at least 3"}},
       {"tree:0", {"at least 1"}},
       {"tree:7:4", {"arity of 1, 2 or 3"}},
       {"tree:7:0", {"arity of 1, 2 or 3"}},
       {"tree:7:", {"found \"\"", "tree:N[:ARITY]"}},
       {"tree:7:2:1", {"found 3 size(s)"}},
       {"mesh:3", {"found 1 size(s)", "mesh:RxC"}},
       {"mesh:3x", {"found \"\"", "mesh:RxC"}},
       {"mesh:3x3x3", {"found 3 size(s)"}},
       {"mesh:0x4", {"at least 1 row"}},
       {"torus:0x4", {"at least 1 row"}},
       {"torus:4x0", {"at least 1 row"}},
       {"binary:0", {"at least 1 processor"}},
       {"binary:7:2", {"found 2 size(s)", "binary:N"}},
       {"amp:0", {"amp:0", "found 0 processors, expected 1 to 65536"}},
       {"amp", {"found \"\"", "amp:N"}},
       {"hypercube:5", {"5 links of processor 0", "at most 4"}},
       {"star:6", {"5 links of processor 0", "at most 4"}},
       {"star:0", {"at least 1"}},
       {"line:65537", {"65537", limit}},
       {"line:99999999999", {"99999999999", limit}},
       {"line:99999999999x", {"expected a size"}},
       {"mesh:100000x100000", {"100000", limit}},
       {"mesh:65536x65536", {"4294967296 processors", limit}},
       {"torus:257x256", {"65792 processors", limit}},
       {"rnig:4", {"unknown generator \"rnig\"", "did you mean \"ring\"", "torus:RxC", ".graphml"}},
       {"hypercub:4", {"did you mean \"hypercube\""}},
       {"Mesh:4x4", {"did you mean \"mesh\""}},
       {"", {"found no name of a generator", "line:N"}},
       {":4", {"found no name of a generator"}},
       {std::string(100000, 'q'), {"unknown generator"}},
       {std::string("line:3\0x", 8), {"line:3"}}},
      [](const std::string& spec) { make_topology(spec); });
}

TEST(TopologyErrors, SizesOfGeneratorsCalledDirectly) {
  for (const int bad : {0, -1, -100000})
    for (auto* make : {make_line, make_ring, make_star, make_binary, make_amp})
      EXPECT_NE(rejection([&] { make(bad); }), "") << bad;
  EXPECT_NE(rejection([] { make_tree(-1); }), "");
  EXPECT_NE(rejection([] { make_mesh(-2, -3); }), "");
  EXPECT_NE(rejection([] { make_torus(-3, -3); }), "");
  EXPECT_NE(rejection([] { make_hypercube(-1); }), "");
  EXPECT_NE(rejection([] { make_hypercube(1 << 30); }), "");
}

// A DOT subgraph of many nodes.
std::string make_group(int nodes) {
  std::string text = "{";
  for (int i = 0; i < nodes; ++i) text += " " + std::to_string(i);
  return text + " }";
}

TEST(TopologyErrors, Dot) {
  expect_rejected(
      {{"", {"x.dot: line 1: found the end of the file, expected graph, digraph or strict"}},
       {"net { a }", {"line 1: found 'net', expected graph, digraph or strict"}},
       {"strict\n{ a }", {"line 2: found '{', expected graph or digraph"}},
       {"graph {\n a -- }", {"line 2: found '}', expected a node or a subgraph"}},
       {"graph { a -- b\n", {"line 2: found the end of the file, expected \"}\""}},
       {"graph {\n a [label=\"open }\n", {"line 2: found the end of the file in a string"}},
       {"graph {\n a [label=<<b> }\n", {"line 2: found the end of the file in HTML"}},
       {"graph {\n a /* b }\n", {"line 2: found the end of the file in a comment"}},
       {"graph {\n\n a -> b }", {"line 3: found '->', expected \"--\" in a graph"}},
       {"digraph {\n a -- b }", {"line 2: found '--', expected \"->\" in a digraph"}},
       {"digraph { a -> }", {"line 1: found '}', expected a node or a subgraph"}},
       {"graph { \"a\\\n\" --\n b; ; }", {"line 3: found ';', expected a node or a subgraph"}},
       {"graph { a [\nbold] }", {"line 2: found ']', expected \"=\""}},
       {"graph { a [x=] }", {"found ']', expected an attribute's value"}},
       {"graph { \"a\" +\n b }", {"line 2: found 'b', expected a string in double quotes"}},
       {"graph {\n 2x -- b }", {"line 2: found '2x', expected a number, or a name in double"}},
       {"graph { 10.0.0.1 -- b }", {"found '10.0.0.1', expected a number, or a name in double"}},
       {"graph { a - b }", {"found '-', expected a name, a string or a symbol"}},
       {"graph { a:0:n:n -- b }", {"found ':'"}},
       {"graph { subgraph s; a }", {"found ';', expected \"{\""}},
       {"graph { node a }", {"found 'a', expected \"[\" after \"node\""}},
       {"graph { a -- b }\ngraph { c }", {"line 2: found 'graph', expected only one graph"}},
       {"graph { a -- b }\n}", {"line 2: found '}', expected only one graph"}},
       {"graph { }", {"x.dot", "empty"}},
       {"graph { a -- b; b -- b }", {"x.dot", "a link from processor \"b\" to itself"}},
       {"graph { a -- b; a -- b; a -- b; b -- a; a -- b }", {"5 links of processor \"a\""}},
       {"graph { a -- b; c -- d }",
        {"expected a connected network", "to processor \"c\"", "root \"a\""}},
       {"graph { a -- b; a--c; a--d; a--e; a--f }", {"5 links of processor \"a\"", "at most 4"}},
       {"graph {\n\n a -- b [port_a=4] }",
        {"x.dot: line 3: edge \"a\" to \"b\"", "port '4'", "0 to 3"}},
       {"graph { a -- b [port_b=east] }", {"port 'east'", "0 to 3"}},
       {"graph { a -- b [tailport=12] }", {"port '12'"}},
       {"graph { a--b [port_a=1]; a--c [port_a=1] }",
        {"port 1 of processor \"a\"", "\"b\" and \"c\""}},
       {"graph {\n a -- b;\n c:7:ne -- a }", {"line 3", "edge \"c\" to \"a\"", "port '7'"}},
       {"graph { root=z; a -- b }", {"found root \"z\", expected a vertex", "\"a\""}},
       {"graph { root=a; a -- b; b [root=true] }", {"two roots, \"a\" and \"b\"", "root"}},
       {"graph {\n a [root=maybe]; a -- b }", {"line 2: vertex \"a\"", "'maybe'", "true or false"}},
       {"graph " + std::string(5000, '{'), {"line 1", "at most 100 nested braces"}},
       {"graph {\n" + make_group(2000) + " -- " + make_group(2000) + " }",
        {"line 2: found 4000000 edges, expected at most 1048576"}}},
      [](const std::string& text) { read_dot(text, "x.dot"); });
}

std::string graphml(const std::string& body) {
  return "<graphml>\n<key id=\"p\" for=\"edge\" attr.name=\"port_a\" attr.type=\"int\"/>\n"
         "<graph edgedefault=\"undirected\">\n" +
         body + "\n</graph></graphml>";
}

TEST(TopologyErrors, Graphml) {
  const std::string ab = R"(<node id="a"/><node id="b"/><edge source="a" target="b"/>)";
  std::string deep, closed;
  for (int i = 0; i < 100000; ++i) deep += "<a>", closed += "</a>";
  expect_rejected(
      {{"", {"x.graphml: line 1: malformed XML: no element found"}},
       {"<graphml>\n<graph>\n<node></graph>", {"line 3: malformed XML: mismatched tag"}},
       {"<graphml>\n<g:graph/></graphml>", {"line 2: malformed XML: unbound prefix"}},
       {"<!DOCTYPE x SYSTEM 'x.dtd'>\n<graphml>&up;</graphml>",
        {"line 2: malformed XML: the entity 'up' is not defined"}},
       {"<html></html>", {"line 1: found <html>, expected <graphml>"}},
       {"\n<graphml></graphml>", {"line 2: found no <graph> in <graphml>"}},
       {graphml(""), {"empty"}},
       {graphml("<node/>"), {"line 4: found <node> without the attribute \"id\""}},
       {graphml(ab + "<edge source=\"a\"/>"), {"<edge> without the attribute \"target\""}},
       {graphml(ab + "\n<edge source=\"a\" target=\"zz\"/>"),
        {"line 5: ", "target is \"zz\"", "expected the id of a node"}},
       {graphml(ab + R"(<node id="a"/>)"), {"line 4: found two nodes with the id \"a\""}},
       {graphml(ab + R"(<edge source="b" target="b"/>)"),
        {"a link from processor \"b\" to itself"}},
       {graphml(ab + R"(<node id="c"/>)"), {"to processor \"c\""}},
       {graphml(R"(<node id="a"/><node id="b"/><edge source="a" target="b"><data key="p">7</data>)"
                "</edge>"),
        {"line 4: edge \"a\" to \"b\": found port '7', expected 0 to 3"}},
       {graphml(R"(<node id="a"/><node id="b"/><edge source="a" target="b" sourceport="5"/>)"),
        {"line 4", "port '5'", "0 to 3"}},
       {graphml(R"(<node id="a"><data key="q">7</data></node>)"),
        {"line 4", "\"q\"", "expected the id of a key"}},
       {graphml(R"(<node id="a"/><node id="b"/><edge id="e" source="a" target="b"/>)"
                R"(<edge id="e" source="b" target="a"/>)"),
        {"line 4: found two edges between the same nodes with the id \"e\""}},
       {deep, {"malformed XML: no element found"}},
       {deep + "</a>", {"line 1: malformed XML"}},
       {graphml(deep + closed), {"empty"}},
       {graphml(ab + "\n<hyperedge><endpoint node=\"a\"/></hyperedge>"),
        {"line 5: found <hyperedge> in <graph>, expected one graph of nodes and edges"}},
       {graphml("<node id=\"a\"/></graph>\n<graph><node id=\"b\"/>"),
        {"line 5: found a second graph"}},
       {graphml("<node id=\"a\">\n<graph/></node>"), {"line 5: found <graph> in <node>"}},
       {graphml(ab + "<edge source=\"a\" target=\"b\">\n<graph/></edge>"),
        {"line 5: found <graph> in <edge>"}},
       {graphml("<locator xlink='a.graphml'/>"), {"line 4: found <locator> in <graph>"}},
       {"<graphml>\n<key id='a'/>\n<key id='a'/><graph/></graphml>",
        {"line 3: found two keys with the id \"a\""}}},
      [](const std::string& text) { read_graphml(text, "x.graphml"); });
}

TEST(TopologyErrors, Files) {
  const TemporaryFile other("net.txt", "graph { a -- b }");
  const auto folder = testing::TempDir() + "tlab-folder-" + std::to_string(getpid()) + ".dot";
  std::filesystem::create_directory(folder);
  expect_rejected({{"no/such/file.dot", {"no/such/file.dot", "No such file"}},
                   {".dot", {"unknown generator"}},
                   {folder, {folder, "cannot be read: Is a directory"}},
                   {other.path, {other.path, "expected .dot, .gv or .graphml"}},
                   {std::string(5000, 'q') + ".dot", {"cannot be read"}}},
                  [](const std::string& spec) { make_topology(spec); });
  std::filesystem::remove(folder);
}

TEST(TopologyErrors, GarbageAndCutFilesAreRejectedNotFatal) {
  const auto t = make_topology("mesh:3x3");
  const std::vector<std::string> whole{to_dot(t), to_graphml(t)};
  for (unsigned seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::string noise(random() % 300, '\0');
    for (auto& c : noise) c = static_cast<char>(random());
    for (auto text : whole) {
      for (int flips = 0; flips < 3; ++flips)
        text[random() % text.size()] = static_cast<char>(seed % 2 ? random() : 32 + random() % 95);
      for (const auto& bytes : {noise, text, text.substr(0, random() % text.size())}) {
        rejection([&] { check(read_dot(bytes, "noise.dot")); });
        rejection([&] { check(read_graphml(bytes, "noise.graphml")); });
      }
    }
  }
}

// Invalid topologies that no reader of files returns, but a program can build. `check` names the
// violation.
TEST(TopologyErrors, HandMadeTopologies) {
  const auto made = [](int processors, int root, std::vector<Link> links) {
    return rejection([&] { check({"made", processors, root, std::move(links), {}, {}}); });
  };
  EXPECT_NE(made(0, 0, {}).find("no processors"), std::string::npos);
  EXPECT_NE(made(2, 2, {{{0, 0}, {1, 0}}}).find("root 2, expected 0 to 1"), std::string::npos);
  EXPECT_NE(made(2, 0, {{{0, 0}, {2, 0}}}).find("ends at processor 2"), std::string::npos);
  EXPECT_NE(made(2, 0, {{{1, 0}, {0, 0}}}).find("expected the lower number first"),
            std::string::npos);
  EXPECT_NE(made(2, 0, {{{0, 4}, {1, 0}}}).find("on port 4, expected 0 to 3"), std::string::npos);
  EXPECT_NE(made(3, 0, {{{0, 0}, {2, 0}}, {{0, 1}, {1, 0}}}).find("in the wrong order"),
            std::string::npos);
  EXPECT_NE(made(99999, 0, {}).find("expected at most 65536"), std::string::npos);
}

}  // namespace
}  // namespace topologies

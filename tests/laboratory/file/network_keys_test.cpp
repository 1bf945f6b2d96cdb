// Routes, trees and faults in experiment files.
#include <limits>

#include "base/errors.hpp"
#include "experiments/laboratory/file/tables.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/faults.hpp"
#include "tests/laboratory/support/load.hpp"
#include "tests/laboratory/support/tlab.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

const std::string CENSUS = "[program]\nname = \"census\"\n[network]\ntopology = \"ring:4\"\n";

std::string told_by_load(const std::string& text) {
  return message_of<base::BadInput>([&] { load(text); });
}

std::optional<topologies::TreeLinks> tree_of(const std::string& keys) {
  const auto e = load(CENSUS + keys).points[0].experiment;
  return find_tree(e, topologies::make_topology("ring:4"));
}

// Reads the faults of a file that has only tables [[fault]], for a ring of four processors.
std::vector<programs::PlannedFault> faults_of(const std::string& text) {
  const auto file = toml::parse(text, std::string_view("e.toml"));
  Experiment experiment;
  experiment.faults = read_faults({"e.toml", "fault", "", *file.get("fault")});
  return find_faults(experiment, topologies::make_topology("ring:4"));
}

TEST(ExperimentsNetworkKeys, TheTreeIsPerRootUnlessSaid) {
  EXPECT_FALSE(tree_of(""));
  EXPECT_FALSE(tree_of("tree = \"per_root\"\ntree_links = []\n"));
  EXPECT_EQ(tree_of("tree = \"single\"\n"), (topologies::TreeLinks{{0, 1}, {0, 3}, {2, 3}}));
  const topologies::TreeLinks given{{0, 3}, {1, 2}, {2, 3}};
  EXPECT_EQ(tree_of("tree = \"single\"\ntree_links = [[3, 2], [1, 2], [0, 3]]\n"), given);
  EXPECT_EQ(tree_of("tree_links = [[3, 2], [1, 2], [0, 3]]\n"), given);
}

TEST(ExperimentsNetworkKeys, ResultsOfANetworkFromAFileAreTheSameFromAnyFolder) {
  const TemporaryFolder folder;
  for (const char* place : {"one", "two/three"}) {
    std::filesystem::create_directories(folder.path / place);
    write_file(folder.path / place / "net.dot", "graph { 0 -- 1 -- 2; }\n");
    write_file(folder.path / place / "e.toml",
               "[program]\nname = \"census\"\n[network]\ntopology = \"net.dot\"\n");
  }
  ASSERT_EQ(tlab(folder.path, {"run", "one/e.toml", "-o", "r"}).exit_code, 0);
  ASSERT_EQ(tlab(folder.path / "two/three", {"run", "e.toml", "-o", "r"}).exit_code, 0);
  const auto results = read_file(folder.path / "r/results.csv");
  EXPECT_EQ(results, read_file(folder.path / "two/three/r/results.csv"));
  EXPECT_NE(results.find("net.dot,"), std::string::npos) << results;
}

TEST(ExperimentsNetworkKeys, XyIsDimensionOrder) {
  const auto e =
      load("[program]\nname = \"census\"\n[network]\ntopology = \"mesh:3x3\"\nroutes = \"xy\"\n")
          .points[0]
          .experiment;
  const auto mesh = topologies::make_topology("mesh:3x3");
  const auto routes = find_routes(e, mesh), xy = topologies::make_xy_routes(mesh);
  for (int from = 0; from < 9; ++from)
    for (int to = 0; to < 9; ++to) EXPECT_EQ(routes.next_port(from, to), xy.next_port(from, to));
  EXPECT_NE(message_of<base::BadInput>([&] {
              check_network(load(CENSUS + "routes = \"xy\"\n").points[0].experiment);
            }).find("found no dimensions for dimension-order routing (xy)"),
            std::string::npos);
}

// Some processors have models of their own, with other clocks. Errors give the file and the line.
TEST(ExperimentsNetworkKeys, ProcessorsMayBeOfOtherModels) {
  const std::string farm = "[network]\nworkers = 3\n";
  const auto others_of = [](const std::string& text) {
    const auto e = load(text).points[0].experiment;
    return find_others(e, make_workers(e), make_model(e.model));
  };
  const auto others = others_of(farm +
                                "[[processor]]\nnumber = 2\nmodel = \"t800-20\"\n"
                                "[[processor]]\nnumber = 0\nmodel = \"t805-30\"\n");
  ASSERT_EQ(others.size(), 2u);
  EXPECT_EQ(others.at(0)->name, "t805-30");
  EXPECT_EQ(others.at(2)->cpu.clock.value, 20e6);
  for (const auto& [tables, message] : std::vector<std::pair<std::string, std::string>>{
           {"number = 3\nmodel = \"t800-20\"",
            "[[processor]] 1: number: found 3, expected processors from 0 to 2"},
           {"number = 1\nmodel = \"t800-2\"", "[[processor]] 1: model: "},
           {"number = 1", "[[processor]] 1: \"model\" is missing"},
           {"model = \"t800-20\"", "[[processor]] 1: \"number\" is missing"},
           {"number = -1\nmodel = \"t800-20\"", "[[processor]] 1: number: found -1"},
           {"number = 65536\nmodel = \"t800-20\"",
            "number: found 65536, expected a whole number from 0 to 65535"},
           {"number = 1\nmodul = \"t800-20\"", "unknown key \"modul\", the nearest valid"},
           {"number = 1\nmodel = \"t800-20\"\n[[processor]]\nnumber = 1\nmodel = \"t805-30\"",
            "[[processor]] 2: number: found 1 twice"}}) {
    const auto told = message_of<base::BadInput>(
        [&, tables = tables] { others_of(farm + "[[processor]]\n" + tables + "\n"); });
    EXPECT_NE(told.find(message), std::string::npos) << tables << "\n" << told;
  }
  EXPECT_NE(told_by_load("[program]\nname = \"commstime\"\n[[processor]]\nnumber = 0\nmodel = "
                         "\"t800-20\"\n")
                .find("does not support processors of other models"),
            std::string::npos);
}

// Tables, drawings, records and sentences call each processor by its name in the DOT file.
TEST(ExperimentsNetworkKeys, NamesOfADotFileAreKept) {
  const TemporaryFolder folder;
  write_file(folder.path / "board.dot",
             "graph { root=ada; ada -- bob; ada -- cyd; ada -- dan; ada -- eve; bob -- cyd; }\n");
  write_file(
      folder.path / "e.toml",
      "[network]\ntopology = \"board.dot\"\n[scene]\nobjects = 9\n[image]\nwidth = 8\n"
      "height = 8\n[report]\nnetworks = \"all\"\n[[processor]]\nnumber = 3\nmodel = \"t800-20\"\n");
  const auto run = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("the link from port 1 of ada to port 0 of cyd is omitted"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("workers of model t800-20: 1, busy"), std::string::npos) << run.out;
  const auto record = read_file(folder.path / "r/run.json");
  for (const auto* text : {"\"name\":\"dan\"", "is omitted", "\"model\":\"t800-20\"", "\"tasks\":"})
    EXPECT_NE(record.find(text), std::string::npos) << text;
  EXPECT_EQ(record.find("worker1"), std::string::npos);
  EXPECT_EQ(read_file(folder.path / "r/results.csv").find("worker1"), std::string::npos);
  std::string drawings;
  for (const auto& file : std::filesystem::directory_iterator(folder.path / "r/networks"))
    drawings += read_file(file.path());
  for (const auto* name : {"ada", "bob", "cyd", "dan", "eve"})
    EXPECT_NE(drawings.find(name), std::string::npos) << name;
}

TEST(ExperimentsNetworkKeys, MistakesInTreesAreNamed) {
  for (const auto& [keys, message] : std::vector<std::pair<std::string, std::string>>{
           {"tree = \"per_root\"\ntree_links = [[0, 1]]\n",
            "found links with network.tree = \"per_root\""},
           {"tree_links = [[0, 4]]\n",
            "network.tree_links: found [0, 4], expected processors from"},
           {"tree_links = [[0, 2]]\n", "network.tree_links: found [0, 2], which is not a link"},
           {"tree_links = [[0, 1], [1, 2]]\n", "found no path from the root 0 to processor 3"},
           {"tree_links = [[0, 1], [1, 2], [2, 3], [3, 0]]\n", "[3, 0], which closes a cycle"},
           {"tree_links = [[0, -1]]\n", "e.toml:5: network.tree_links: found"},
           {"tree_links = 3\n", "found 3, expected the links of a spanning tree, [[a, b], ...]"},
           {"tree = \"one\"\n", "expected one of per_root, single"}}) {
    const auto told = message_of<base::BadInput>([&, keys = keys] { tree_of(keys); });
    EXPECT_NE(told.find(message), std::string::npos) << keys << told;
  }
}

TEST(ExperimentsNetworkKeys, OnlyProgramsThatUseThemHaveRoutesAndFaults) {
  for (const char* key : {"routes = \"r.csv\"", "tree = \"single\"", "tree_links = [[0, 1]]"}) {
    const std::string network = std::string("[network]\n") + key + "\n";
    for (const char* program : {"farm", "unicast"}) {
      const auto told = told_by_load(fmt::format("[program]\nname = \"{}\"\n{}", program, network));
      EXPECT_NE(told.find(fmt::format("the program {} does not support routes and trees, expected "
                                      "one of iirra, traffic, metrics, census",
                                      program)),
                std::string::npos)
          << told;
    }
  }
  const std::string fault = "[[fault]]\nprocessor = 1\nat_s = 1\n";
  EXPECT_NE(told_by_load(CENSUS + fault).find("the program census does not support faults"),
            std::string::npos);
}

TEST(ExperimentsFaults, AreOfLinksOrProcessors) {
  using Fault = programs::PlannedFault;
  EXPECT_EQ(faults_of("fault = []\n"), std::vector<Fault>{});
  EXPECT_EQ(faults_of("[[fault]]\nlink = [3, 0]\nat_s = 0.5\n[[fault]]\nprocessor = 2\nat_s = 0\n"),
            (std::vector<Fault>{{0.5, 3, 0}, {0, 2, -1}}));
}

// The values of a fault are part of the point's key.
TEST(ExperimentsFaults, BelongToThePoint) {
  const auto file =
      std::make_shared<const toml::table>(toml::parse("[[fault]]\nprocessor = 1\nat_s = 0.25\n"));
  const auto keys = list_keys(file);
  ASSERT_EQ(keys.size(), 1u);
  const auto& [key, node] = *keys.begin();
  EXPECT_EQ(key, "fault");
  EXPECT_NE(to_toml(*node).find("at_s = 0.25"), std::string::npos);
}

TEST(ExperimentsFaults, MistakesAreNamed) {
  // the text has four lines, and the second [[fault]] is in line 4
  const std::string good = "[[fault]]\nprocessor = 0\nat_s = 1\n[[fault]]\n";
  for (const auto& [keys, message] : std::vector<std::pair<std::string, std::string>>{
           {"processor = 4\nat_s = 1\n",
            "e.toml:4: [[fault]] 2: found 4, expected processors from 0 to 3"},
           {"link = [0, 9]\nat_s = 1\n",
            "e.toml:4: [[fault]] 2: found 9, expected processors from 0 to 3"},
           {"link = [0, 2]\nat_s = 1\n",
            "[[fault]] 2: found link = [0, 2], expected a link of ring:4: it has none from 0 to 2"},
           {"link = [1, 1]\nat_s = 1\n", "expected a link of ring:4: it has none from 1 to 1"},
           {"at_s = 1\n", "e.toml:4: [[fault]] 2: found no link and no processor, expected either"},
           {"link = [0, 1]\nprocessor = 1\nat_s = 1\n", "found both a link and a processor"},
           {"processor = 1\n", "e.toml:4: [[fault]] 2: \"at_s\" is missing"},
           {"processor = 1\nat_s = -2\n",
            "e.toml:6: [[fault]] 2: at_s: found -2, expected a number from 0"},
           {"processor = 1\nat_s = nan\n", "[[fault]] 2: at_s: found nan, expected a number"},
           {"processor = 1\nat_s = inf\n", "[[fault]] 2: at_s: found inf, expected a number"},
           {"processor = -1\nat_s = 1\n", "[[fault]] 2: processor: found -1"},
           {"link = [0]\nat_s = 1\n", "e.toml:5: [[fault]] 2: link: found"},
           {"link = [0, 1.5]\nat_s = 1\n", "expected two processors that a link joins, [a, b]"},
           {"links = [0, 1]\nat_s = 1\n", "the nearest valid key is \"link\""}}) {
    const auto told = message_of<base::BadInput>([&, keys = keys] { faults_of(good + keys); });
    EXPECT_NE(told.find(message), std::string::npos) << keys << told;
  }
}

TEST(ExperimentsRoutes, OfAFileBelongToThePoint) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& row) {
    std::ofstream(folder.path / "r.csv") << "from,to,path\n" + row;
  };
  std::ofstream(folder.path / "e.toml") << CENSUS << "routes = \"r.csv\"\n";
  const auto passed = [&] {
    const auto done = tlab(folder.path, {"run", "e.toml", "-o", "r"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
    std::vector<double> counts;
    for (const auto& row : table.rows)
      counts.push_back(*as_number(row[*table.find("routes_through")]));
    return counts;
  };
  write("0,2,0-3-2\n");
  const auto three = passed();
  write("0,2,0-1-2\n");
  const auto one = passed();
  EXPECT_EQ(one[1] - three[1], 2);
  EXPECT_EQ(three[3] - one[3], 2);
  EXPECT_NE(read_file(folder.path / "r/run.json").find("r.csv\": \""), std::string::npos);
  write("0,2,0-2\n");
  const auto refused = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("e.toml: "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("r.csv:2: found a step from 0 to 2"), std::string::npos)
      << refused.err;
}

TEST(ExperimentsRoutes, AreAnAxis) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "r.csv") << "from,to,path\n0,2,0-3-2\n";
  std::ofstream(folder.path / "e.toml") << CENSUS << "[sweep]\nroutes = [\"\", \"r.csv\"]\n"
                                        << "tree = [\"per_root\", \"single\"]\n";
  const auto done = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  EXPECT_EQ(table.rows.size(), 16u);
  EXPECT_EQ(table.rows[8][0], Value("r.csv"));
}

TEST(ExperimentsRoutes, AndTreesEnterThePointsKey) {
  const auto key = [](const std::string& more) {
    return make_keys(load(CENSUS + more), std::numeric_limits<double>::infinity()).at(0);
  };
  EXPECT_EQ(key(""), key(""));
  EXPECT_NE(key(""), key("tree = \"single\"\n"));
  EXPECT_NE(key("tree_links = [[0, 1], [1, 2], [2, 3]]\n"),
            key("tree_links = [[0, 1], [1, 2], [3, 0]]\n"));
}

}  // namespace
}  // namespace laboratory

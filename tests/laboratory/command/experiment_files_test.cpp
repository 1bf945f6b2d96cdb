// Every experiment below experiments/, at reduced size: its checks hold, and the engines agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"
#include "tests/support/isolated.hpp"
#include "tests/support/places.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// Settings that reduce the long experiments.
const std::map<std::string, std::vector<std::string>>& reductions() {
  static const std::map<std::string, std::vector<std::string>> all{
      {"formulas/both-ways", {"program.messages=200", "sweep.bytes=[16, 4096]"}},
      {"formulas/farm-limits", {"sweep.topology=[\"tree\"]", "sweep.workers=[5, 11, 17]"}},
      {"formulas/amdahl-law", {"sweep.serial_fraction=[0, 0.05]", "sweep.workers=[1, 4, 16]"}},
      {"formulas/gustafson-law", {"sweep.serial_fraction=[0, 0.05]", "sweep.workers=[1, 4, 16]"}},
      {"formulas/message", {"sweep.switches=[0, 3]", "sweep.bytes=[0, 1, 4, 65536]"}},
      {"formulas/pipeline", {"sweep.stages=[3, 8]", "sweep.bytes=[4, 1000]"}},
      {"formulas/broadcast", {"sweep.bytes=[100]"}},
      {"studies/shared-scene",
       {"scene.objects=400", "image.width=16", "image.height=16", "sweep.workers=[4]",
        "sweep.cache_percent=[0, 10, 100]"}},
      {"farm", {"sweep.objects=[200]", "sweep.workers=[1, 7]"}},
      {"thesis/table-4.2", {"sweep.objects=[200, 800]", "sweep.workers=[1, 2, 4, 7]"}},
      {"thesis/bounds",
       {"image.width=20", "image.height=20", "sweep.workers=[4]", "sweep.depth=[2, 5]"}},
      {"thesis/bounds-mirrors", {"image.width=48", "image.height=48", "sweep.depth=[1, 8]"}},
      {"thesis/bounds-stages", {"image.width=20", "image.height=20"}},
      {"studies/mixed-boards", {"image.width=48", "image.height=48", "let.low=\"0.32\""}},
      {"studies/topologies",
       {"sweep.task=[\"ray\", \"block:2x2\"]", "image.width=24", "image.height=24",
        "sweep.topology, workers=[[\"tree\", 1], [\"tree\", 8], [\"amp\", 1], "
        "[\"amp\", 8]]"}},
      {"studies/amdahl", {"sweep.width, height=[[16, 16], [32, 32]]", "sweep.workers=[1, 4, 16]"}},
      {"studies/routers",
       {"sweep.topology=[\"mesh:4x4\"]", "sweep.load=[0.01, 0.05]", "program.window_s=0.02"}},
      {"studies/data-managers",
       {"sweep.topology=[\"mesh:4x4\"]", "sweep.cache_percent=[10]", "sweep.zipf=[1]"}},
      {"studies/realism",
       {"image.width=48", "image.height=48", "sweep.objects=[800]",
        "sweep.cells=[\"constant\", \"point\"]", "sweep.order=[\"random\", \"sequential\"]",
        "let.most=\"0.6\""}},
      {"paper/noise",
       {"program.width=32", "program.height=32", "program.pixel_samples=64",
        "program.reference=512"}},
      {"paper/adaptive",
       {"program.width=64", "program.height=64", "program.reference=256",
        "sweep.scene, adaptive=[[\"spheres:200\", 0.015]]", "let.most=\"0.8\""}},
      {"paper/samples",
       {"image.width=16", "image.height=16", "sweep.pixel_samples=[1, 16]",
        "sweep.program, task, topology=[[\"farm\", \"ray\", \"tree:1\"], "
        "[\"farm\", \"ray\", \"tree:30\"], [\"iirra\", \"ray\", \"line:3\"], "
        "[\"iirra\", \"ray\", \"mesh:3x3\"]]"}},
      {"paper/display",
       {"image.width=32", "image.height=32", "sweep.objects, depth=[[10, 1], [200, 4]]",
        "sweep.topology=[\"tree:1\", \"tree:4\"]"}},
      {"thesis/cells", {"image.width=48", "image.height=48"}},
      {"thesis/figure-4.19", {"image.width=96", "image.height=96"}},
      {"studies/soak", {"program.messages=5000"}},
      {"thesis/table-5.2", {"sweep.message_bytes=[4]"}},
      {"thesis/table-5.3", {"program.messages=500", "sweep.message_bytes=[4, 32, 512]"}},
      {"thesis/figure-5.8", {"sweep.s_p=[0.1, 0.5, 1]", "sweep.n=[2, 10]"}},
      {"thesis/table-5.4", {"sweep.cache_percent=[1, 36, 100]"}},
      {"studies/radiosity-scaling",
       {"program.refine=3", "program.max_shots=10", "program.width=32", "program.height=24",
        "sweep.topology=[\"mesh\"]", "sweep.workers=[1, 16]", "let.least=\"6\""}},
      {"studies/radiosity-distribution",
       {"program.refine=2", "program.max_shots=3", "program.width=32", "program.height=24",
        "sweep.borders, cache_percent=[[\"exchanged\", 0], [\"exchanged\", 50]]"}},
      {"thesis/figure-5.24",
       {"scene.objects=50", "image.width=64", "image.height=64",
        "sweep.start=[\"scattered\", \"blocks\"]", "sweep.cell=[8, 2]", "let.least=\"0.8\""}},
      {"thesis/figure-5.28", {"scene.objects=20"}},
      {"thesis/figure-5.29", {"scene.objects=50"}},
      {"studies/iirra-balance",
       {"network.topology=\"mesh:3x3\"", "scene.objects=50", "image.width=64", "image.height=64",
        "sweep.start, cell=[[\"scattered\", 4], [\"scattered\", 8], [\"blocks\", 4], "
        "[\"blocks\", 8]]",
        "sweep.balance=[\"neighbours\", \"ring\"]", "let.least=\"0.6\"", "let.most=\"0.5\""}},
      {"studies/iirra-caches",
       {"network.topology=\"mesh:3x3\"", "scene.objects=50", "image.width=24", "image.height=24",
        "sweep.cache_percent=[0, 50]"}},
      {"studies/iirra-scaling",
       {"image.width=64", "image.height=64", "sweep.source=[\"spheres:200\"]",
        "sweep.program, task, topology, cell=[[\"farm\", \"ray\", \"tree:14\", 16], "
        "[\"iirra\", \"ray\", \"mesh:8x8\", 4], "
        "[\"iirra\", \"ray\", \"../reference/figure-5.15.dot\", 16]]",
        "let.least=\"0.3\""}},
      {"studies/iirra-orders",
       {"scene.objects=50", "image.width=64", "image.height=64",
        "sweep.program, topology, iirra.order, iirra.weights=[[\"farm\", \"tree\", \"random\", "
        "[1, 4, 2, 1, 1, 1]], [\"iirra\", \"mesh\", \"bayer\", [1, 4, 2, 1, 1, 1]]]"}},
      {"paper/figure-9", {"program.width=64", "program.height=64", "let.least=\"0.7\""}},
      {"thesis/table-4.1", {"program.width=96", "program.height=96"}},
      {"thesis/figure-4.5", {"program.width=64", "program.height=64", "program.depth=4"}},
      {"thesis/figure-4.6", {"program.width=129", "program.height=129"}},
      {"thesis/figure-3.8",
       {"program.tolerance=0.1", "program.reference_refine=4", "program.width=160",
        "program.height=120", "network.workers=1"}},
      {"thesis/figure-3.9",
       {"program.tolerance=0.1", "program.reference_refine=4", "program.width=160",
        "program.height=120"}},
      {"thesis/figure-3.16",
       {"program.tolerance=0.1", "program.refine=1", "program.width=64", "program.height=48",
        "network.workers=1"}},
      {"thesis/figure-3.18",
       {"program.tolerance=0.1", "program.width=64", "program.height=48", "network.workers=1"}},
      {"formulas/unicast", {"sweep.hops=[0, 1, 4]", "sweep.bytes=[4, 100]"}},
  };
  return all;
}

// Names such as "formulas/soft" of files with checks; excludes the machine models beside them.
std::vector<std::string> find_experiments() {
  const fs::path root = ::test::in_sources("experiments");
  std::vector<std::string> found;
  for (const auto& file : fs::recursive_directory_iterator(root)) {
    if (file.path().extension() != ".toml") continue;
    if (read_file(file.path()).find("[[check]]") == std::string::npos) continue;
    found.push_back(file.path().lexically_relative(root).replace_extension().string());
  }
  std::ranges::sort(found);
  return found;
}

TEST(ExperimentFiles, AreFoundAndTheirReductionsNameThem) {
  const auto found = find_experiments();
  EXPECT_GE(found.size(), 40u);
  for (const auto& [name, ignored] : reductions())
    EXPECT_NE(std::ranges::find(found, name), found.end()) << name;
}

TEST(ExperimentFiles, HaveNamesOfTheirOwn) {
  std::map<std::string, std::string> paths;
  for (const auto& path : find_experiments()) {
    const auto [other, is_new] = paths.emplace(fs::path(path).filename(), path);
    EXPECT_TRUE(is_new) << path << " and " << other->second << " share a folder of results";
  }
}

// Runs tlab verify or run on an experiment at reduced size.
Outcome tlab_reduced(const fs::path& folder, const std::string& command,
                     const std::string& experiment, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{command,
                                     ::test::in_sources("experiments/" + experiment + ".toml")};
  if (const auto reduced = reductions().find(experiment); reduced != reductions().end())
    for (const auto& set : reduced->second) arguments.insert(arguments.end(), {"--set", set});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return tlab(folder, arguments);
}

std::string name_of(const testing::TestParamInfo<std::string>& at) {
  std::string name = at.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

class Experiments : public testing::TestWithParam<std::string> {};

constexpr double ROUNDING = 1e-9;

// Numbers may differ by the rounding of dates; all else must be equal.
void expect_near(const Table& table, const Table& expected) {
  ASSERT_EQ(table.columns, expected.columns);
  ASSERT_EQ(table.rows.size(), expected.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      const Value &value = table.rows[row][column], &other = expected.rows[row][column];
      if (is_same(value, other)) continue;
      ASSERT_TRUE(as_number(value) && as_number(other)) << to_string(value) << to_string(other);
      EXPECT_NEAR(*as_number(value), *as_number(other), ROUNDING * std::abs(*as_number(other)))
          << table.columns[column] << " of row " << row + 1;
    }
}

// These take long on SimGrid's engine. Both engines run similar experiments: figure 4.19 and table
// 4.2.
bool is_on_one_engine(const std::string& experiment) {
  return experiment == "thesis/figure-4.18" || experiment == "thesis/figure-4.20";
}

TEST_P(Experiments, ChecksHoldOnEveryEngine) {
  const TemporaryFolder folder;
  const auto verify = [&](const std::string& engine) {
    const auto done = tlab_reduced(folder.path, "verify", GetParam(),
                                   {"-o", engine, "--set", "run.engine=" + engine});
    EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
    EXPECT_NE(done.out.find(" hold, 0 do not\n"), std::string::npos) << done.out;
    return parse_csv(read_file(folder.path / engine / "results.csv"), engine);
  };
  const auto direct = verify("direct");
  if (!is_on_one_engine(GetParam())) expect_near(direct, verify("simgrid"));
}

INSTANTIATE_TEST_SUITE_P(Of, Experiments, testing::ValuesIn(find_experiments()), name_of);

struct ExperimentsOnActors : testing::TestWithParam<std::string> {
  void SetUp() override {
    if (test::IS_SANITIZED) GTEST_SKIP();
  }
};

TEST_P(ExperimentsOnActors, GiveTheBytesThatFibersGive) {
  const TemporaryFolder folder;
  for (const std::string processes : {"fibers", "actors"}) {
    const auto done = tlab_reduced(folder.path, "run", GetParam(),
                                   {"-o", processes, "--set", "run.processes=" + processes});
    EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
  }
  const auto on_fibers = read_file(folder.path / "fibers/results.csv");
  EXPECT_NE(on_fibers.find('\n'), on_fibers.rfind('\n')) << "no rows: " << on_fibers;
  EXPECT_EQ(read_file(folder.path / "actors/results.csv"), on_fibers);
}

std::vector<std::string> find_formulas() {
  auto all = find_experiments();
  std::erase_if(all, [](const auto& name) { return !name.starts_with("formulas/"); });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Formulas, ExperimentsOnActors, testing::ValuesIn(find_formulas()),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Systems, ExperimentsOnActors,
                         testing::Values("paper/display", "studies/soak", "studies/faults",
                                         "studies/shared-scene", "studies/radiosity-scaling"),
                         name_of);

}  // namespace
}  // namespace laboratory

// Every experiment below experiments/, at reduced size: its checks hold, and both engines agree.
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

// Finds experiments with checks, by names such as "formulas/soft". Excludes the models beside them.
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

TEST(ExperimentFiles, AreFound) { EXPECT_GE(find_experiments().size(), 40u); }

TEST(ExperimentFiles, HaveNamesOfTheirOwn) {
  std::map<std::string, std::string> paths;
  for (const auto& path : find_experiments()) {
    const auto [other, is_new] = paths.emplace(fs::path(path).filename(), path);
    EXPECT_TRUE(is_new) << path << " and " << other->second << " share a folder of results";
  }
}

// Runs `tlab verify` or `tlab run` on an experiment at reduced size.
Outcome tlab_reduced(const fs::path& folder, const std::string& command,
                     const std::string& experiment, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{
      command, ::test::in_sources("experiments/" + experiment + ".toml"), "--reduced"};
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

// Numbers may differ by the rounding of simulated times. Everything else must be equal.
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

// True for experiments that take long on SimGrid's engine. The similar figure 4.19 and table 4.2
// run on both engines.
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

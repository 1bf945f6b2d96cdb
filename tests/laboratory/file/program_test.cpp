// Experiments with programs other than the farm, and with changed entries of the machine model.
#include <fstream>

#include "base/errors.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/load.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

const std::string MESSAGE = "[program]\nname = \"message\"\n";

TEST(ExperimentsProgram, ParametersHaveDefaultsAndAreAxes) {
  EXPECT_EQ(load("").points[0].experiment.program->name, "farm");
  EXPECT_EQ(show_value(load(MESSAGE).points[0].experiment, "bytes"), "100");
  EXPECT_EQ(show_value(load(MESSAGE + "bytes = 7\n").points[0].experiment, "bytes"), "7");
  const auto file = load(MESSAGE + "[sweep]\nbytes = [1, 2e1]\n");
  ASSERT_EQ(file.points.size(), 2u);
  EXPECT_EQ(show_value(file.points[1].experiment, "bytes"), "20");
  EXPECT_EQ(file.points[1].numbers.at("program.bytes"), 20);
}

TEST(ExperimentsProgram, AxesKeepTheOrderOfTheFileWithSetToo) {
  const auto file =
      load(MESSAGE + "[sweep]\nmodel.link.one_way_rate = [1e6]\nbytes = [1, 2]\n",
           {"sweep.model.link.one_way_rate=[2e6, 3e6]", "sweep.model.cpu.clock=[1e6]"});
  EXPECT_EQ(axes_of(file), (std::vector<std::string>{"link.one_way_rate", "bytes", "cpu.clock"}));
  ASSERT_EQ(file.points.size(), 4u);
  EXPECT_EQ(make_model(file.points[3].experiment.model).link.one_way_rate, 3e6);
  EXPECT_EQ(make_model(file.points[3].experiment.model).cpu.clock.value, 1e6);
}

TEST(ExperimentsModel, NumbersOfTheMachineAreReplaced) {
  const auto file = load("[model.link]\none_way_rate = 1e6\n[machine]\nmodel = \"t800-20\"\n",
                         {"model.channel.blocked=30"});
  const auto model = make_model(file.points[0].experiment.model);
  EXPECT_EQ(model.link.one_way_rate, 1e6);
  EXPECT_EQ(model.channel.blocked.value, 30);
  EXPECT_EQ(model.cpu.clock.value, 20e6);
  EXPECT_EQ(models_of(file).size(), 1u);
  EXPECT_EQ(models_of(load("[sweep]\n\"model.cpu.clock\" = [1e6, 2e6]\nworkers = [1, 2]\n")).size(),
            2u);
  EXPECT_NE(message_of<base::BadInput>([] {
              make_model(load("[model.link]\none_way_rat = 1\n").points[0].experiment.model);
            })
                .find("model.link.one_way_rat: unknown key, the nearest valid one is "
                      "\"link.one_way_rate\""),
            std::string::npos);
}

TEST(ExperimentsProgram, MistakesAreNamed) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[program]\nname = \"mesage\"\n",
            "e.toml:2: program.name: found 'mesage', expected one of farm,"},
           {"[program]\nname = 3\n", "program.name: found 3, expected one of farm, iirra"},
           {"[program]\nbytes = 3\n", "unknown key \"program.bytes\""},
           {MESSAGE + "byte = 3\n",
            "e.toml:3: unknown key \"program.byte\", the nearest valid key is \"program.bytes\""},
           {"[program]\nname = \"metrics\"\nx = 3\n", "the program metrics has no parameters"},
           {MESSAGE + "bytes = -1\n",
            "e.toml:3: program.bytes: found -1, expected a whole number from 0 to"},
           {MESSAGE + "bytes = 1.5\n", "found 1.5, expected a whole number"},
           {MESSAGE + "bytes = \"x\"\n", "found 'x', expected a whole number"},
           {MESSAGE + "bytes = nan\n", "expected a whole number"},
           {MESSAGE + "[sweep]\nbytes = [1, -1]\n", "e.toml:4: program.bytes: found -1"},
           {MESSAGE + "[sweep]\nbyte = [1]\n",
            "unknown axis \"byte\" in [sweep], the nearest valid one is \"bytes\""},
           {MESSAGE + "[sweep]\nname = [\"farm\"]\n", "unknown axis \"name\""},
           {MESSAGE + "[sweep]\nbytes = [1]\n\"program.bytes\" = [1]\n",
            "expected each axis only once"},
           {MESSAGE + "[network]\nworkers = 3\n", "the program message has its own network"},
           {MESSAGE + "[image]\nwidth = 3\n",
            "e.toml:4: image.width is a key of the farm, but program.name is \"message\""},
           {MESSAGE + "[[stage]]\nmin_cell = 3\n", "stage is a key of the farm"},
           {MESSAGE + "[[order]]\nat_s = 3\n", "order is a key of the farm"},
           {MESSAGE + "[farm]\nseed = 3\n", "farm.seed is a key of the farm"},
           {MESSAGE + "[sweep]\nobjects = [3]\n", "scene.objects is a key of the farm"},
           {MESSAGE + "[machine]\nworker_memory_bytes = 3\n", "is a key of the farm"},
           {"[model.link]\none_way_rate = true\n",
            "e.toml:2: model.link.one_way_rate: found true, expected a number"}}) {
    const auto told = message_of<base::BadInput>([&, text = text] { load(text); });
    EXPECT_NE(told.find(message), std::string::npos) << text << told;
  }
}

TEST(ExperimentsProgram, ResultsHaveAxesThenParametersThenTheRow) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "m.toml")
      << MESSAGE << "bytes = 50\n[sweep]\n\"model.link.one_way_rate\" = [1e6, 2e6]\n";
  std::ofstream(folder.path / "n.toml") << "[program]\nname = \"metrics\"\n[sweep]\nworkers = [4, "
                                           "16]\ntopology = [\"line\", \"ring\"]\n";
  for (const char* name : {"m", "n"}) {
    const auto done = tlab(folder.path, {"run", std::string(name) + ".toml", "-o", name});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    for (const char* file : {"run.json", "report.html"})
      EXPECT_TRUE(std::filesystem::exists(folder.path / name / file)) << name << file;
    EXPECT_FALSE(std::filesystem::exists(folder.path / name / "checks.csv"));
  }
  const auto m = parse_csv(read_file(folder.path / "m/results.csv"), "m");
  EXPECT_EQ(m.columns, (std::vector<std::string>{"link.one_way_rate", "bytes", "switches",
                                                 "latency_s", "ended"}));
  EXPECT_NEAR(*as_number(m.rows[0][3]) - *as_number(m.rows[1][3]), 50e-6 - 25e-6, 1e-11);
  EXPECT_TRUE(std::filesystem::exists(folder.path / "m/plots/latency_s.svg"));
  EXPECT_NE(read_file(folder.path / "m/run.json").find("with link.one_way_rate = 2"),
            std::string::npos);
  const auto n = parse_csv(read_file(folder.path / "n/results.csv"), "n");
  EXPECT_EQ(n.columns, (std::vector<std::string>{"processors", "topology", "rows", "columns",
                                                 "links", "degree_max", "diameter", "mean_distance",
                                                 "busiest_link", "bisection", "ended"}));
  EXPECT_EQ(n.rows[3][6], Value(std::int64_t{8}));
}

TEST(ExperimentsModel, TheFarmRunsOnTheModelOfItsPoint) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml")
      << "[image]\nwidth = 8\nheight = 8\n[scene]\nobjects = 5\n[network]\nworkers = 2\n"
         "[sweep]\n\"model.cpu.clock\" = [25e6, 50e6]\n";
  const auto done = tlab(folder.path, {"run", "e.toml", "-o", "r"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  EXPECT_EQ(table.columns[3], "cpu.clock");
  const auto time = *table.find("time_s");
  EXPECT_GT(*as_number(table.rows[0][time]), 1.5 * *as_number(table.rows[1][time]));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "r"))
    EXPECT_NE(entry.path().extension(), ".toml") << entry.path();
}

}  // namespace
}  // namespace laboratory

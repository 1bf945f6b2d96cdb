// Experiment files: what they contain, and the error messages for mistakes in them.
#include "experiments/laboratory/file/experiment.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "base/random.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

TEST(ExperimentsFile, DefaultsAreOnePoint) {
  const auto file = load("");
  ASSERT_EQ(file.points.size(), 1u);
  const Experiment& e = file.points[0].experiment;
  EXPECT_EQ(e.model.source.text, "t805-25");
  EXPECT_EQ(make_workers(e).name, "tree:7");
  EXPECT_EQ(ray_tracing::scene_source(farm_of(e).scene), "spheres:200");
  EXPECT_EQ(farm_of(e).machine.image.limits.depth, 15);
}

TEST(ExperimentsFile, SweepSpansItsAxesInOrderTheLastFastest) {
  const auto file = load("[sweep]\nobjects = [200, 800]\nworkers = [1, 2, 3]\n");
  EXPECT_EQ(axes_of(file), (std::vector<std::string>{"objects", "workers"}));
  ASSERT_EQ(file.points.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(objects_of(file.points[i].experiment), i < 3 ? 200 : 800);
    EXPECT_EQ(file.points[i].experiment.workers, static_cast<std::int64_t>(i % 3 + 1));
  }
}

TEST(ExperimentsFile, NumbersInAnyBaseAndTextsOfAnyShapeAreReadAgain) {
  EXPECT_EQ(spell_keys(load("[image]\nheight = 0x10\n").keys),
            spell_keys(load("[image]\nheight = 16\n").keys));
  const auto file = load("title = \"\"\"\n\n  two\nlines\"\"\"\n[image]\nheight = 0x10\n");
  EXPECT_EQ(file.points[0].experiment.title, "\n  two\nlines");
  const auto again = load(resolve(file));
  EXPECT_EQ(again.points[0].experiment.title, file.points[0].experiment.title);
  EXPECT_EQ(spell_keys(again.keys), spell_keys(file.keys));
}

TEST(ExperimentsFile, CoupledAxesMoveTogether) {
  const std::string text =
      "[sweep]\nobjects = [200, 800]\n\"workers, height\" = [[1, 16], [2, 16], [4, 32]]\n";
  const auto file = load(text);
  EXPECT_EQ(axes_of(file), (std::vector<std::string>{"objects", "workers", "height"}));
  EXPECT_EQ(file.sweep.at(1).size(), 2u);
  ASSERT_EQ(file.points.size(), 6u);
  EXPECT_EQ(objects_of(file.points[5].experiment), 800);
  EXPECT_EQ(file.points[5].experiment.workers, 4);
  EXPECT_EQ(farm_of(file.points[5].experiment).machine.image.height, 32);
  EXPECT_EQ(name_of(file.points[5]), "objects = 800, workers = 4, height = 32");
  EXPECT_TRUE(resolve(file).ends_with(
      "[sweep]\nobjects = [200, 800]\n\"workers, height\" = [[1, 16], [2, 16], [4, 32]]"))
      << resolve(file);
  EXPECT_EQ(resolve(load(resolve(file))), resolve(file));
  for (const char* key : {"sweep.workers, height", "sweep.\"workers,height\""})
    EXPECT_EQ(load(text, {std::string(key) + "=[[3, 8]]"}).points.size(), 2u) << key;
  EXPECT_EQ(load(text, {"sweep={\"workers, height\" = [[3, 8]]}"}).points.size(), 1u);
  for (const auto& [sweep, message] : std::vector<std::pair<std::string, std::string>>{
           {"\"workers, height\" = [[1, 16], [2]]",
            "sweep.workers, height: found [ 2 ], expected an array of 2 values, workers, height"},
           {"\"workers, height\" = [1, 2]", "found 1, expected an array of 2 values"},
           {"\"workers, height\" = [[1, 16], [1, 16.0]]",
            "expected each value only once: found [ 1, 16.0 ]"},
           {"\"workers, heigt\" = [[1, 16]]", "unknown axis \"heigt\""},
           {"\"workers, workers\" = [[1, 1]]",
            "expected each axis only once: found network.workers"},
           {"height = [1]\n\"workers, height\" = [[1, 16]]",
            "expected each axis only once: found image.height"}})
    EXPECT_NE(
        message_of<base::BadInput>([&, &s = sweep] { load("[sweep]\n" + s + "\n"); }).find(message),
        std::string::npos)
        << message_of<base::BadInput>([&, &s = sweep] { load("[sweep]\n" + s + "\n"); });
}

TEST(ExperimentsFile, SetReplacesAnyKey) {
  const auto file = load("[network]\ntopology = \"tree\"\n[sweep]\nworkers = [1, 2]\n",
                         {"network.topology=ring", "sweep.workers=[5]", "image.width=64",
                          "title=\"A = b\"", "sweep.objects=[7, 9]"});
  ASSERT_EQ(file.points.size(), 2u);
  EXPECT_EQ(file.points[0].experiment.topology.text, "ring");
  EXPECT_EQ(file.points[1].experiment.workers, 5);
  EXPECT_EQ(objects_of(file.points[1].experiment), 9);
  EXPECT_EQ(file.points[0].experiment.title, "A = b");
  EXPECT_EQ(farm_of(file.points[0].experiment).machine.image.width, 64);
}

TEST(ExperimentsFile, SetTakesKeysOfAsManyPartsAsAFile) {
  const auto told = [](int parts) {
    std::string key;
    for (int i = 1; i < parts; ++i) key += "a.";
    return message_of<base::BadInput>([&] { load("", {key + "a=1"}); });
  };
  const auto expected = "a=1: found a key of more than 16 parts, expected at most 16";
  EXPECT_NE(told(17).find(expected), std::string::npos) << told(17);
  EXPECT_NE(told(16).find("unknown key"), std::string::npos) << told(16);
}

// "counted" is valid for every program, also for those whose costs cannot be timed.
TEST(ExperimentsFile, CostsOfAnyProgramMayBeCounted) {
  const auto file =
      load("title = \"timed\"\n[program]\nname = \"message\"\n[run]\ncost = \"counted\"\n");
  EXPECT_FALSE(file.points[0].experiment.is_timed);
}

TEST(ExperimentsFile, TasksAreRaysOrBlocksOfAnySize) {
  const auto block = [](const std::string& task) {
    return farm_of(load("[farm]\ntask = \"" + task + "\"\n").points[0].experiment).machine.block;
  };
  EXPECT_FALSE(block("ray"));
  for (const auto& [width, height] : {std::pair(1, 1), {1, 7}, {7, 1}, {64, 32}}) {
    const auto found = block(fmt::format("block:{}x{}", width, height));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->width, width);
    EXPECT_EQ(found->height, height);
  }
  for (const char* wrong : {"block:0x1", "block:1x0", "block:4", "block:4x", "block:4x4 ", "rays"})
    EXPECT_THROW(block(wrong), base::BadInput) << wrong;
}

TEST(ExperimentsFile, StagesAndOrders) {
  const auto file = load(
      "[[stage]]\nmin_cell = 4\ndepth_reflected = 1\n[[stage]]\narea = [1, 2, 3, 4]\n"
      "[[order]]\nat_s = 2\nmin_influence = 0.5\n[[order]]\nat_s = 3.5\nnon_interactive = true\n");
  const auto& p = farm_of(file.points[0].experiment).machine;
  ASSERT_EQ(p.stages.size(), 2u);
  EXPECT_EQ(p.stages[0].min_cell, 4);
  EXPECT_EQ(p.stages[1].area, (renderer::Area{1, 2, 3, 4}));
  ASSERT_EQ(p.script.size(), 2u);
  EXPECT_EQ(std::get<farm::Limits>(p.script[0].what).min_influence, 0.5);
  EXPECT_TRUE(std::holds_alternative<farm::NonInteractive>(p.script[1].what));
}

TEST(ExperimentsFile, PathsAreRelativeToTheFile) {
  const auto file = load("[scene]\nsource = \"a/b.nff\"\n[network]\ntopology = \"net.dot\"\n");
  const Experiment& e = file.points[0].experiment;
  const auto folder = std::filesystem::path(file.path).parent_path();
  EXPECT_EQ(farm_of(e).scene.source, (base::Source{"a/b.nff", (folder / "a/b.nff").string()}));
  EXPECT_EQ(e.topology, (base::Source{"net.dot", (folder / "net.dot").string()}));
}

TEST(ExperimentsFile, TopologiesOfANumberOfWorkers) {
  for (const auto& [name, workers, spec] :
       std::vector<std::tuple<std::string, int, std::string>>{{"tree", 5, "tree:5"},
                                                              {"line", 1, "line:1"},
                                                              {"ring", 2, "line:2"},
                                                              {"ring", 3, "ring:3"},
                                                              {"mesh", 12, "mesh:3x4"},
                                                              {"mesh", 7, "mesh:1x7"},
                                                              {"torus", 9, "torus:3x3"},
                                                              {"torus", 4, "torus:2x2"},
                                                              {"torus", 8, "torus:2x4"},
                                                              {"binary", 12, "binary:12"},
                                                              {"amp", 20, "amp:20"},
                                                              {"hypercube", 16, "hypercube:4"},
                                                              {"hypercube", 8, "hypercube:3"},
                                                              {"tree:4:2", 9, "tree:4:2"}}) {
    Experiment e;
    e.topology.path = name;
    e.workers = workers;
    EXPECT_EQ(make_workers(e).name, spec);
  }
  Experiment e;
  e.topology.path = "hypercube";
  for (const int workers : {6, 32, 256}) {
    e.workers = workers;
    const auto told = message_of<base::BadInput>([&] { make_workers(e); });
    EXPECT_NE(told.find("network.workers: found " + std::to_string(workers)), told.npos) << told;
    EXPECT_NE(told.find("expected 1, 2, 4, 8 or 16"), told.npos) << told;
  }
}

TEST(ExperimentsFile, EveryTopologyCanBeSizedByAPowerOfTwo) {
  for (const char* name : {"line", "ring", "binary", "tree", "mesh", "torus", "hypercube", "amp"})
    for (int workers = 1; workers <= 256; workers *= 2) {
      if (name == std::string("hypercube") && workers > 16) break;
      Experiment e;
      e.topology.path = name;
      e.workers = workers;
      const auto topology = make_workers(e);
      EXPECT_EQ(topology.processors, workers) << name;
      EXPECT_NO_THROW(topologies::check(topology)) << name << workers;
    }
}

TEST(ExperimentsFile, MistakesAreNamed) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[scene]\nobject = 3\n",
            "e.toml:2: unknown key \"scene.object\", the nearest valid "
            "key is \"scene.objects\""},
           {"titel = 1\n", "unknown key \"titel\", the nearest valid key is \"title\""},
           {"[network]\nworkers = 0\n",
            "e.toml:2: network.workers: found 0, expected a whole number from 1 to 65536"},
           {"[network]\nworkers = 2.5\n", "found 2.5, expected a whole number"},
           {"[network]\nworkers = \"two\"\n", "expected a whole number"},
           {"[image]\nfeelers = \"some\"\n", "expected one of all, front"},
           {"[image]\nmin_influence = nan\n", "expected a number from 0 to 1"},
           {"[image]\narea = [1, 2]\n", "expected [x, y, width, height] in pixels"},
           {"[image]\narea = [0, 0.5, 8, 8]\n", "expected [x, y, width, height] in pixels"},
           {"[image]\narea = [-1, 0, 8, 8]\n", "expected [x, y, width, height] in pixels"},
           {"[image]\narea = [0, 0, 1e9, 8]\n", "expected [x, y, width, height] in pixels"},
           {"[sweep]\nworker = [1]\n",
            "unknown axis \"worker\" in [sweep], the nearest valid one "
            "is \"workers\""},
           {"[sweep]\nworkers = 3\n", "sweep.workers: found 3, expected an array of values"},
           {"[sweep]\nworkers = []\n",
            "sweep.workers: found [], expected an array of values, at least one"},
           {"[sweep]\nworkers = [1, 2, 1]\n", "expected each value only once: found 1 twice"},
           {"[sweep]\nambient = [2, 0.5, 2.0]\n", "expected each value only once: found 2.0 twice"},
           {"sweep = 3\n", "sweep: expected a section of axes"},
           {"[scene\nobjects = 3\n", "e.toml:1: "},
           {"stage = 3\n", "expected one or more [[stage]]"},
           {"[[stage]]\ncell = 3\n", "unknown key \"cell\", the nearest valid key is \"min_cell\""},
           {"[run]\ncost = \"guessed\"\n", "expected one of counted"},
           {"[run]\nprocesses = \"threads\"\n",
            "run.processes: found 'threads', expected one of fibers, actors"},
           {"[run]\nengine = \"direct\"\nprocesses = \"actors\"\n",
            "run.processes: found actors with run.engine = \"direct\", expected fibers"},
           {"[run]\nengine = \"ns3\"\n",
            "run.engine: found 'ns3', expected one of simgrid, direct"}}) {
    const auto told = message_of<base::BadInput>([&, text = text] { load(text); });
    EXPECT_NE(told.find(message), std::string::npos) << text << told;
  }
  for (const char* override : {"workers", "=3", "sweep.workers.deep=3", "image.width=64\nx = 3"})
    EXPECT_NE(message_of<base::BadInput>([&] { load("[sweep]\nworkers=[1]\n", {override}); }), "")
        << override;
  EXPECT_NE(message_of<base::BadInput>([] { load_experiment(std::string("/nowhere/e.toml"), {}); }),
            "");
}

TEST(ExperimentsFile, TooManyPointsAreRefusedBeforeTheyAreMade) {
  std::string list = "[1";
  for (int i = 2; i <= 10'000; ++i) list += fmt::format(", {}", i);
  const std::string sweep = "[sweep]\nworkers = " + list + "]\nobjects = " + list + "]\n";
  for (const auto& [more, count] :
       {std::pair("", "100000000 points"), std::pair("width = [1, 2]\n", "200000000 points")})
    EXPECT_NE(message_of<base::BadInput>([&, more = more] {
                load(sweep + more);
              }).find(fmt::format("spans {}, expected at most 100000", count)),
              std::string::npos);
}

// The text written by resolve() gives the same experiment: the points in the same order, with exact
// numbers.
TEST(ExperimentsFile, WhatIsResolvedCanBeReadAgain) {
  const auto file = load(
      "title = \"a \\\"b\\\"\"\n[sweep]\n\"model.link.one_way_rate\" = [1.7e6, 1e6]\n"
      "\"network.workers\" = [3, 2]\nobjects = [30, 2, 10]\n",
      {"model.cpu.clock=20.1e6"});
  const auto again = load_experiment({resolve(file), "e.toml", ""}, {});
  ASSERT_EQ(again.points.size(), file.points.size());
  EXPECT_EQ(axes_of(again), axes_of(file));
  EXPECT_EQ(spell_keys(again.keys), spell_keys(file.keys));
  EXPECT_EQ(resolve(again), resolve(file));
  for (std::size_t i = 0; i < file.points.size(); ++i)
    EXPECT_EQ(name_of(again.points[i]), name_of(file.points[i]));
}

// Overrides with values of every kind. Their texts contain quotes, escapes, line ends, and text
// that looks like TOML.
TEST(ExperimentsFile, TheTextOfAnOverrideIsReadAgain) {
  constexpr std::string_view LETTERS = "ab1.= \"'\\\n\t[]{}#,";
  for (std::uint64_t i = 0; i < 300; ++i) {
    std::string text;
    for (std::uint64_t k = 0; k < i % 12; ++k)
      text += LETTERS[base::random_at(i, k) % LETTERS.size()];
    const auto whole = static_cast<std::int64_t>(base::random_at(i, 20) >> (i % 64)) / 2;
    for (const base::Scalar& value :
         {base::Scalar(text), base::Scalar(whole), base::Scalar(i % 2 == 0),
          base::Scalar(std::ldexp(static_cast<double>(whole), static_cast<int>(i % 99) - 50)),
          base::Scalar(std::vector{text, text})}) {
      const Override made{"a.b", make_node(value)};
      const auto read = parse_override(made.text());
      EXPECT_EQ(read.key, made.key);
      EXPECT_EQ(base::to_toml(*read.value), base::to_toml(*made.value)) << made.text();
    }
  }
}

TEST(ExperimentsFile, ATextStandsForAListOfOne) {
  const auto over = [](const std::string& value) {
    return load("[[best]]\nname = \"b\"\nof = \"time_s\"\nover = " + value + "\n").bests.at(0).over;
  };
  EXPECT_EQ(over("\"workers\""), over("[\"workers\"]"));
  EXPECT_THROW(over("[3]"), base::BadInput);
}

}  // namespace
}  // namespace laboratory

// Keys of points: points with equal keys have equal results.
#include "experiments/laboratory/points/point_store.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

// A key depends on everything that the result depends on, and on nothing else.
TEST(ExperimentsPointKey, DependsOnWhatAPointDoes) {
  const double never = std::numeric_limits<double>::infinity();
  const auto key = [&](const std::string& text, double until_s = 1e300) {
    return make_keys(load(text), until_s).at(0);
  };
  const std::string base = "[image]\nwidth = 10\n";
  EXPECT_EQ(key(base), key("title = \"t\"\nquestion = \"q\"\n" + base +
                           "[let]\na = \"1\"\n[[check]]\nname = \"c\"\nof = \"rays\"\nwithin = 1\n"
                           "formula = \"1\"\n"));
  EXPECT_EQ(key(base), key("[sweep]\nwidth = [10]\n"));
  EXPECT_EQ(key(base, never), make_keys(load("[sweep]\nwidth = [7, 10]\n"), never).at(1));
  for (const char* more :
       {"height = 10\n", "[farm]\nseed = 2\n", "[model.cpu]\nclock = 20e6\n",
        "[machine]\nmodel = \"t800-20\"\n", "[[stage]]\nmin_cell = 2\n", "[network]\nworkers = 2\n",
        "[[processor]]\nnumber = 1\nmodel = \"t800-20\"\n"})
    EXPECT_NE(key(base), key(base + more)) << more;
  const auto with = [&](const std::string& number, const std::string& model) {
    return key(base + "[[processor]]\nnumber = " + number + "\nmodel = \"" + model + "\"\n");
  };
  EXPECT_NE(with("1", "t800-20"), with("2", "t800-20"));
  EXPECT_NE(with("1", "t800-20"), with("1", "t805-30"));
  EXPECT_NE(key(base), key(base, 3.5));
}

TEST(ExperimentsPointKey, DependsOnWhatFilesHold) {
  const TemporaryFolder folder;
  const auto key = [&] {
    return make_keys(
               load_experiment(
                   {"[network]\ntopology = \"net.dot\"\n", "e.toml", folder.path.string()}, {}),
               1)
        .at(0);
  };
  std::ofstream(folder.path / "net.dot") << "graph { a--b }";
  const auto first = key();
  EXPECT_EQ(key(), first);
  std::ofstream(folder.path / "net.dot") << "graph { a--b b--c }";
  EXPECT_NE(key(), first);
}

TEST(ExperimentsPointKey, DependsOnWhatTheModelFileOfAProcessorHolds) {
  const TemporaryFolder folder;
  const auto key = [&](const std::string& clock) {
    std::ofstream(folder.path / "mine.toml")
        << "name = \"mine\"\nbase = \"t805-25\"\n[cpu]\nclock = { value = " << clock
        << ", unit = \"Hz\", provenance = \"datasheet\", source = \"a label\" }\n";
    return make_keys(load_experiment({"[[processor]]\nnumber = 1\nmodel = \"mine.toml\"\n",
                                      "e.toml", folder.path.string()},
                                     {}),
                     1)
        .at(0);
  };
  const auto first = key("20e6");
  EXPECT_EQ(key("20e6"), first);
  EXPECT_NE(key("17e6"), first);
}

}  // namespace
}  // namespace laboratory

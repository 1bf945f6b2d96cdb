// Keys of points: equal where the results are.
#include "experiments/laboratory/points/point_store.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

// A key changes with what changes the result, and with nothing else.
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
  for (const char* more : {"height = 10\n", "[farm]\nseed = 2\n", "[model.cpu]\nclock = 20e6\n",
                           "[machine]\nmodel = \"t800-20\"\n", "[[stage]]\nmin_cell = 2\n",
                           "[network]\nworkers = 2\n"})
    EXPECT_NE(key(base), key(base + more)) << more;
  EXPECT_NE(key(base), key(base, 3.5));
}

TEST(ExperimentsPointKey, DependsOnWhatFilesHold) {
  const TemporaryFolder folder;
  const auto key = [&] {
    return make_keys(read_experiment("[network]\ntopology = \"net.dot\"\n", "e.toml",
                                     folder.path.string(), {}),
                     1)
        .at(0);
  };
  std::ofstream(folder.path / "net.dot") << "graph { a--b }";
  const auto first = key();
  EXPECT_EQ(key(), first);
  std::ofstream(folder.path / "net.dot") << "graph { a--b b--c }";
  EXPECT_NE(key(), first);
}

}  // namespace
}  // namespace laboratory

// run.repetitions: consecutive seeds as an axis of the sweep.
#include "base/errors.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

const std::string LOADED =
    "[program]\nname = \"router_load\"\nseed = 7\n[sweep]\nload = [0.1, 0.2]\n";

TEST(ExperimentsRepetitions, AreConsecutiveSeeds) {
  const auto file = load(LOADED + "[run]\nrepetitions = 3\n");
  EXPECT_EQ(axes_of(file), (Texts{"load", "seed"}));
  ASSERT_EQ(file.points.size(), 6u);
  EXPECT_EQ(name_of(file.points[0]), "load = 0.1, seed = 7");
  EXPECT_EQ(name_of(file.points[5]), "load = 0.2, seed = 9");
}

// The text written by resolve() has the axis of seeds instead of the key, and gives the same
// points.
TEST(ExperimentsRepetitions, AreResolvedToTheAxis) {
  const auto text = resolve(load(LOADED + "[run]\nrepetitions = 3\n"));
  EXPECT_FALSE(contains(text, "repetitions")) << text;
  EXPECT_EQ(load(text).points.size(), 6u);
}

TEST(ExperimentsRepetitions, OfAProgramWithTwoSeedsAreCoupled) {
  const auto file = load("[run]\nrepetitions = 2\n[farm]\norder = \"random\"\n");
  EXPECT_EQ(file.points.size(), 2u);
  for (const auto& axis : axes_of(file)) EXPECT_TRUE(axis.ends_with("seed")) << axis;
}

TEST(ExperimentsRepetitions, OfOneAreNoAxis) {
  const auto file = load(LOADED + "[run]\nrepetitions = 1\n");
  EXPECT_EQ(axes_of(file), (Texts{"load"}));
}

TEST(ExperimentsRepetitions, CanBeSetByTheCommand) {
  EXPECT_EQ(load(LOADED, {"run.repetitions=4"}).points.size(), 8u);
}

TEST(ExperimentsRepetitions, AreRefusedWhereTheyMeanNothing) {
  const auto message = [](const std::string& text) {
    return message_of<base::BadInput>([&] { load(text); });
  };
  EXPECT_TRUE(contains(message("[program]\nname = \"message\"\n[run]\nrepetitions = 2\n"),
                       "the program message has no seed"));
  EXPECT_TRUE(contains(message(LOADED + "seed = [1, 2]\n[run]\nrepetitions = 2\n"),
                       "found the axis seed in [sweep] too"));
  EXPECT_TRUE(contains(message(LOADED + "repetitions = [1, 2]\n"), "not an axis"));
  EXPECT_TRUE(contains(message(LOADED + "[run]\nrepetitions = 0\n"), "run.repetitions"));
}

}  // namespace
}  // namespace laboratory

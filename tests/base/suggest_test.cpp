// What is offered in the place of an unknown name.
#include "base/suggest.hpp"

#include <gtest/gtest.h>

namespace base {
namespace {

const std::vector<std::string> COMMANDS = {"topology", "render", "run", "verify"};

TEST(Suggest, SimilarNamesAreOffered) {
  EXPECT_EQ(suggest("runn", COMMANDS), ", the nearest is \"run\"");
  EXPECT_EQ(suggest("topolgy", COMMANDS, "try"), ", try \"topology\"");
  EXPECT_EQ(suggest("cell", {"time", "min_cell"}), ", the nearest is \"min_cell\"");
  EXPECT_EQ(did_you_mean("verfy", COMMANDS), " (did you mean \"verify\"?)");
}

TEST(Suggest, OthersAreNot) {
  EXPECT_EQ(suggest("list", COMMANDS), ", expected one of topology, render, run, verify");
  EXPECT_EQ(did_you_mean("list", COMMANDS), "");
  EXPECT_EQ(did_you_mean(std::string(1'000'000, 'r'), COMMANDS), "");
  EXPECT_EQ(suggest("list", {}), "");
}

}  // namespace
}  // namespace base

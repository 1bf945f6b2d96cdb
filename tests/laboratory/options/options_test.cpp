// Options that several commands share: their values and their help.
#include "experiments/laboratory/options/options.hpp"

#include <gtest/gtest.h>

#include "tests/laboratory/support/support.hpp"

namespace laboratory {
namespace {

TEST(Options, TheHelpSaysWhatAFieldMayBe) {
  using Kind = base::Domain::Kind;
  CLI::App app;
  const auto add = [&](const char* name, const base::Domain& domain, const base::Scalar& standard) {
    add_field_option(app, name, "", domain, standard, [](const base::Scalar&) { return ""; });
  };
  add("most_coats", {Kind::whole, 1, 9}, std::int64_t{3});
  add("width", {Kind::number, 0.5, 2}, 1.5);
  add("paint", {Kind::choice, 0, 0, {"red", "green"}}, "green");
  add("painter", {Kind::text}, "none");
  for (const char* text : {"--most-coats 1..9 [3]", "--width 0.5..2 [1.5]",
                           "--paint red|green [green]", "--painter TEXT [none]"})
    EXPECT_TRUE(contains(app.help(), text)) << app.help();
}

TEST(Options, JobsAreFrom1To1024) {
  CLI::App app;
  RunOptions options;
  add_run_options(app, options, "", "");
  for (const int jobs : {1, 1024}) {
    app.parse("--jobs " + std::to_string(jobs));
    EXPECT_EQ(options.jobs, static_cast<unsigned>(jobs));
  }
  for (const char* jobs : {"0", "1025"})
    EXPECT_THROW(app.parse(std::string("--jobs ") + jobs), CLI::ValidationError) << jobs;
}

}  // namespace
}  // namespace laboratory

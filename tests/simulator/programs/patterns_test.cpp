// Every pattern at its defaults, on a small network; what each measures is checked by experiments.
#include "simulator/declare/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "tests/support/support.hpp"

namespace programs {
namespace {

Setup make_setup(const machine::Model& model, const Pattern& pattern) {
  Setup setup{model, topologies::make_topology(pattern.uses_topology ? "tree:4" : "line:1"), {}};
  for (const auto& p : pattern.parameters) setup.parameters[p.name] = p.value;
  setup.pattern = &pattern;
  if (pattern.uses_routes) setup.routes = topologies::make_routes(setup.topology);
  return setup;
}

TEST(Patterns, HaveUniqueNamesAndDefaultsInRange) {
  std::set<std::string> names{"farm"};
  for (const auto& pattern : all_patterns()) {
    EXPECT_TRUE(names.insert(pattern.name).second) << pattern.name;
    std::set<std::string> parameters{"name", "topology", "workers", "processors"};
    for (const auto& p : pattern.parameters) {
      EXPECT_TRUE(parameters.insert(p.name).second) << pattern.name << "." << p.name;
      EXPECT_LE(p.low, p.value) << pattern.name << "." << p.name;
      EXPECT_LE(p.value, p.high) << pattern.name << "." << p.name;
      EXPECT_TRUE(!p.whole || p.value == std::floor(p.value)) << pattern.name << "." << p.name;
    }
    for (const auto& part : pattern.parts)
      EXPECT_TRUE(parameters.insert(part).second) << pattern.name << "." << part;
  }
}

TEST(Patterns, RunAtTheirDefaults) {
  const auto model = machine::load_model("t805-25");
  for (const auto& pattern : all_patterns()) {
    if (pattern.name == "deadlock") continue;  // see ExperimentsDeadlock
    // See Radiosity.
    if (std::ranges::any_of(pattern.parameters, &programs::Parameter::is_required)) continue;
    const auto columns = occam::isolated(
        [&] { return std::to_string(pattern.run(make_setup(model, pattern)).rows.at(0).size()); });
    EXPECT_NE(columns, "0") << pattern.name;
  }
}

// The sender starts its link; then the bytes, one after the other.
TEST(Patterns, AMessageTakesItsStartAndItsBytes) {
  const auto model = occam::make_exact_model();
  for (const double bytes : {1.0, 80.0, 3000.0}) {
    const auto found = occam::isolated_numbers([&] {
      const Pattern& message = all_patterns().at(0);
      programs::Setup setup = make_setup(model, message);
      setup.parameters["bytes"] = bytes;
      return occam::Numbers{message.run(setup).rows.at(0).at(0).second};
    });
    EXPECT_NEAR(found.at(0) * model.cpu.clock.value,
                static_cast<double>(model.channel.blocked.value) + 16 * bytes, 1e-3);
  }
  EXPECT_THROW((programs::Setup{model, {}, {}}["bytes"]), base::InvariantBroken);
}

// One processor has no link, and its only queue is its own client's.
TEST(Patterns, ANetworkDeliversToItsSender) {
  const auto model = machine::load_model("t805-25");
  const auto unicast = std::ranges::find(all_patterns(), "unicast", &Pattern::name);
  const auto columns = occam::isolated_numbers([&] {
    programs::Setup setup = make_setup(model, *unicast);
    setup.topology = topologies::make_topology("line:1");
    setup.parameters["hops"] = 0;
    occam::Numbers numbers;
    const Row row = unicast->run(setup).rows.at(0);
    for (const auto& [name, value] : row) numbers.push_back(value);
    return numbers;
  });
  EXPECT_GT(columns.at(0), 0);
  EXPECT_EQ(columns.at(1), 2);  // its queue's: the entry, and the sender that is free again
}

}  // namespace
}  // namespace programs
